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
  % An error ends the program; behind a \n Octave does not tell the line it came from.
  number = str2double(port);
  if ~(number >= 1 && number <= 65535 && number == fix(number))
    error('the port has to be a number from 1 to 65535, not ''%s''\n', port);
  end
  try
    robot.line = tcpclient(host, number, 'Timeout', 5);
  catch
    error('no robot answers at %s port %s: is the server running? ./run\n', host, port);
  end
  robot.joints = 'FEDCBA';
  robot.at = [0 0 0 0 0 0];
end
