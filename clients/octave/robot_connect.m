function robot = robot_connect()
% Connects to HOST and PORT of the arguments, else of XR3_HOST and XR3_PORT, else to localhost 9600.
% The result has the line, and in `at` where the motors are, in counts from the soft home, in the
% order of `joints`, as far as robot_go moved them.
  pkg load instrument-control  % leave this out in MATLAB
  host = getenv('XR3_HOST');
  port = getenv('XR3_PORT');
  arguments = argv();
  if numel(arguments) > 0, host = arguments{1}; end
  if numel(arguments) > 1, port = arguments{2}; end
  if isempty(host), host = 'localhost'; end
  if isempty(port), port = '9600'; end
  robot.line = tcpclient(host, str2double(port), 'Timeout', 10);
  robot.joints = 'FEDCBA';
  robot.at = [0 0 0 0 0 0];
end
