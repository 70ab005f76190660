% 6. Find with the camera and pick: look at the table, find the largest block, pick it up, put it
% down elsewhere, and look again.
%
%     octave-cli ex6_find_and_pick.m [HOST [PORT]]
%
% The arm must be at its soft home, as when the simulator starts or after ex3_home.m. find_largest.m
% analyses the picture, and counts_at.m is the inverse kinematics.

z = 20;       % height of the largest block's centre, mm
above = 100;  % height above it for approach and departure, mm
open = -16;   % count of A with open jaws
shut = 64;    % count of A with closed jaws

robot = robot_connect();
block = find_largest(robot);

robot = robot_go(robot, [0 0 0 0 0 open]);
robot = robot_go(robot, counts_at(block, z + above));
robot = robot_go(robot, counts_at(block, z));
robot_send(robot, 'A+90\r');  % as in example 5
robot.at(6) = open + (90 - robot_wait(robot, 'A'));
if robot.at(6) >= shut
  robot = robot_go(robot, counts_at(block, z + above));  % back to the start position
  robot = robot_go(robot, [0 0 0 0 0 0]);
  error(['the jaws closed on nothing: is the block at x %.0f, y %.0f mm? (The examples 3 to 6 ' ...
         'are for the Rhino XR-3 with its own workcell)\n'], ...
        block.x, block.y);
end
fprintf('the jaws closed on %.1f mm\n', 50.8 - 0.79375 * robot.at(6));
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
