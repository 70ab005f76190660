function robot_send(robot, varargin)
% Sends commands; the arguments are those of sprintf. A move must end with \r.
  write(robot.line, uint8(sprintf(varargin{:})));
end
