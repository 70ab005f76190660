function reply = robot_ask(robot, inquiry)
% Asks, and returns the byte that answers.
  robot_send(robot, '%s', inquiry);
  reply = double(read(robot.line, 1));
end
