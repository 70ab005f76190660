% 1. Hello: connect to the robot, ask it two questions, print the answers.
%
%     octave-cli 1_hello.m [HOST [PORT]]
%
% A robot on a serial line knows no lines of text and no "OK". It answers a question with one byte,
% and everything else with silence.

% Octave has its sockets in a package. (MATLAB has them built in, and needs no such line.)
pkg load instrument-control

% Where the robot is: from the arguments, else from the environment, else this machine.
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
  robot = tcpclient(host, number, 'Timeout', 5);
catch
  error('no robot answers at %s port %s: is the server running? ./run\n', host, port);
end
strange = 'no robot answers like this; is it the monitor port? The robot port is 9600';

% How far has the shoulder, joint E, still to go? The answer is counted from 32, the code of a
% blank, so that it can be printed: a blank means 0 counts to go, "!" means 1, and so on. (Bytes
% are turned into doubles, for a byte that would be less than 0 becomes 0.)
write(robot, uint8('E?'));
reply = double(read(robot, 1));
if isempty(reply), error('%s\n', strange); end
fprintf('E? is answered by %d: %d counts to go\n', reply, reply - 32);

% Which microswitches are closed? Again 32 is added; each switch has a bit of its own.
write(robot, uint8('I'));
reply = double(read(robot, 1));
if isempty(reply), error('%s\n', strange); end
fprintf('I is answered by %d: switches %d\n', reply, reply - 32);

clear robot  % closes the line
