function robot = robot_connect()
% Connects to HOST and PORT from the arguments, else XR3_HOST and XR3_PORT, else localhost 9600. The
% result has the connection in `line` and in `at` the motor positions in counts from the soft home,
% in the order of `joints`, as tracked by robot_go.
  words = robot_arguments();
  host = getenv('XR3_HOST');
  port = getenv('XR3_PORT');
  if numel(words) > 0, host = words{1}; end
  if numel(words) > 1, port = words{2}; end
  if isempty(host), host = 'localhost'; end
  if isempty(port), port = '9600'; end
  % An error ends the program; after a final \n Octave does not print the source line.
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
