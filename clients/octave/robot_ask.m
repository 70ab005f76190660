function reply = robot_ask(robot, inquiry)
% Sends an inquiry and returns the one-byte answer.
  robot_send(robot, '%s', inquiry);
  reply = double(read(robot.line, 1));
  if isempty(reply)  % after 5 seconds: a robot answers at once
    error('%s\n', 'no robot answers like this; is it the monitor port? The robot port is 9600');
  end
end
