% 1. Hello: connect to the robot, ask it two questions, print the answers.
%
%     octave-cli ex1_hello.m [HOST [PORT]]
%
% The robot's serial protocol has no lines of text and no "OK". The robot answers most questions
% with one byte and does not answer other commands.

% In Octave, sockets are in a package. (In MATLAB they are built in, and programs have no arguments.)
words = {};
if exist('OCTAVE_VERSION', 'builtin')
  pkg('load', 'instrument-control');
  words = argv();
  if any(strncmp(words, '-', 1)), words = {}; end  % at Octave's prompt: its own options
  % Without a folder for its history, Octave would print an error at the end.
  if ~exist(fileparts(fileparts(history_file())), 'dir'), history_save(false); end
end

% Host and port: from the arguments, else from the environment, else the defaults.
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
  robot = tcpclient(host, number, 'Timeout', 5);
catch
  error('no robot answers at %s port %s: is the server running? ./run\n', host, port);
end
wrong_reply = 'no robot answers like this; is it the monitor port? The robot port is 9600';

% Ask how many counts the shoulder, joint E, still has to go. 32, the code of a blank, is added to
% the answer to make it printable: a blank means 0 counts to go, "!" means 1, and so on. (Bytes are
% converted to doubles, since uint8 arithmetic saturates at 0.)
write(robot, uint8('E?'));
reply = double(read(robot, 1));
if isempty(reply), error('%s\n', wrong_reply); end
fprintf('E? is answered by %d: %d counts to go\n', reply, reply - 32);

% Which microswitches are closed? Again 32 is added; each switch has one bit.
write(robot, uint8('I'));
reply = double(read(robot, 1));
if isempty(reply), error('%s\n', wrong_reply); end
fprintf('I is answered by %d: switches %d\n', reply, reply - 32);

clear robot  % closes the line
