% 6. Find with the camera and pick: look at the table, find the largest block wherever it lies, take
% it, put it down elsewhere, and look again.
%
%     octave-cli 6_find_and_pick.m [HOST [PORT]]
%
% The arm has to be at its soft home, as it is when the simulator starts, or after 3_home.m. Taking
% the picture apart is the work of find_largest.m, and inverse kinematics of counts_at.m.

z = 20;       % the largest block is 40 mm high: this is its middle
above = 100;  % how far above it the tool comes and goes, mm
open = 16;    % counts of the open jaws

robot = robot_connect();
block = find_largest(robot);

robot = robot_go(robot, [0 0 0 0 0 open]);
robot = robot_go(robot, counts_at(block, z + above));
robot = robot_go(robot, counts_at(block, z));
robot_send(robot, 'A-100\r');  % as in example 5
robot.at(6) = open - (100 - robot_wait(robot, 'A'));
fprintf('the jaws closed on %.1f mm\n', 50.8 + 0.79375 * robot.at(6));
robot = robot_go(robot, counts_at(block, z + above));

% A free place, the block's long side along y.
target.x = 392;
target.y = 60;
target.angle = 90;
robot = robot_go(robot, counts_at(target, z + above));
robot = robot_go(robot, counts_at(target, z));
robot = robot_go(robot, [counts_at(target, z) open]);
robot = robot_go(robot, counts_at(target, z + above));
fprintf('put down at x %d, y %d mm\n', target.x, target.y);

find_largest(robot);
robot = robot_go(robot, [0 0 0 0 0 0]);
fprintf('back at the start\n');

clear robot
