% 4. Two joints at once, with speeds: base and shoulder start together and arrive together.
%
%     octave-cli 4_two_joints.m [HOST [PORT]]

robot = robot_connect();

% A number with an S behind it is a speed, in counts a second. E has twice as far to go as F, so it
% gets twice the speed.
robot_send(robot, 'F40S E80S\r');
fprintf('F runs at 40 counts a second, E at 80\n');

% Each joint has a motor of its own, and the robot does not wait: both run from here on.
robot_send(robot, 'F+40 E+80\r');
fprintf('F+40 E+80\n');

f = robot_to_go(robot, 'F');
e = robot_to_go(robot, 'E');
while f > 0 || e > 0
  fprintf('  F %d, E %d counts to go\n', f, e);
  pause(0.05);
  f = robot_to_go(robot, 'F');
  e = robot_to_go(robot, 'E');
end
fprintf('both are there\n');

% And back again. robot_wait is example 2 once more, for one joint after the other.
robot_send(robot, 'F-40 E-80\r');
robot_wait(robot, 'F');
robot_wait(robot, 'E');
fprintf('both are back\n');

clear robot
