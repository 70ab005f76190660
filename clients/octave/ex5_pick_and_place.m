% 5. Pick and place at known positions: pick up the red block and put it down elsewhere.
%
%     octave-cli ex5_pick_and_place.m [HOST [PORT]]
%
% The arm must be at its soft home, as when the simulator starts or after ex3_home.m.

% Motor counts from the soft home for each position of the tool. `xr3 kin --pose 262,0,20 --down 90`
% computes those at the block, whose centre is at x 262, y 0 and z 20 mm, with a yaw of 90 degrees.
% "Above" is 100 mm higher. On a real arm one would move there manually and note the counts.
%              F    E     D  C    B
above_block = [0  242  -440  0    0];
at_block =    [0  449  -625  0    0];
above_place = [0  483  -238  0  288];  % x 400, y 0, not turned
at_place =    [0  623  -354  0  288];
home =        [0    0     0  0    0];
shut = 64;  % count of A at which the jaws are closed

robot = robot_connect();

% robot_go moves all joints to these counts together. A single move is limited to 127 counts, so it
% sends several and waits after each. A sixth number is for the jaws, A, fully open at -16.
robot = robot_go(robot, [home -16]);
fprintf('the jaws are open\n');
robot = robot_go(robot, above_block);
fprintf('above the block\n');
robot = robot_go(robot, at_block);

% Command the jaws to close much further than the block permits. They stop at the block, and the
% remaining counts give its width: A is 50.8 mm open at count 0, and a count is 0.79375 mm.
% robot_wait also cancels the remaining counts (AX); otherwise the jaws would keep pressing.
robot_send(robot, 'A+90\r');
robot.at(6) = -16 + (90 - robot_wait(robot, 'A'));
if robot.at(6) >= shut
  robot = robot_go(robot, above_block);  % back to the start position
  robot = robot_go(robot, [home 0]);
  error('%s\n', ['the jaws closed on nothing: is the block at x 262, y 0 mm? Restart the ' ...
                 'server to have it there (the examples 3 to 6 are for the Rhino XR-3 with its ' ...
                 'own workcell)']);
end
fprintf('the jaws closed on %.1f mm\n', 50.8 - 0.79375 * robot.at(6));

robot = robot_go(robot, above_block);
fprintf('lifted\n');
robot = robot_go(robot, above_place);
robot = robot_go(robot, at_place);
fprintf('at its new place\n');
robot = robot_go(robot, [at_place -16]);
fprintf('let go\n');
robot = robot_go(robot, above_place);
robot = robot_go(robot, [home 0]);
fprintf('back at the start\n');

clear robot
