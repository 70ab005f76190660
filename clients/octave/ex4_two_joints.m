% 4. Two joints at once: base and shoulder start together, and the program waits for both.
%
%     octave-cli ex4_two_joints.m [HOST [PORT]]

robot = robot_connect();

% Each joint has its own motor, and the robot does not wait: both start now.
% The simulator can also set speeds, as in F40S. A Mark III cannot: it reads F40 as a move.
robot_send(robot, 'F+40 E+80\r');
fprintf('F+40 E+80\n');

f = robot_to_go(robot, 'F');
e = robot_to_go(robot, 'E');
same = 0;
while f > 0 || e > 0
  fprintf('  F %d, E %d counts to go\n', f, e);
  robot_pause();
  before = f + e;
  f = robot_to_go(robot, 'F');
  e = robot_to_go(robot, 'E');
  if f + e == before, same = same + 1; else, same = 0; end
  if same == robot_stands_after()  % as in example 2
    robot_send(robot, 'FX EX');  % cancels the rest of the moves
    break
  end
end
if f > 0, robot_stands('F', f); end
if e > 0, robot_stands('E', e); end
fprintf('both are there\n');

% Move back. robot_wait is the loop of example 2, for one joint after the other.
robot_send(robot, 'F-40 E-80\r');
f = robot_wait(robot, 'F');
e = robot_wait(robot, 'E');
if f > 0, robot_stands('F', f); end
if e > 0, robot_stands('E', e); end
fprintf('both are back\n');

clear robot
