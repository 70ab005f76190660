% 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
% switch that closes at a known position. Searching for it tells where the joint is.
%
%     octave-cli ex3_home.m [HOST [PORT]]

% The jaws come first: they show how a closed switch reads. The elbow, joint D, follows, since it
% lifts the hand off the table.
joints = 'ADECBF';

% Counts at which the switches close, from the soft home: upper arm upright, forearm level, tool
% down. Seen from there each is open before this count, and closed from it on: for a few dozen
% counts on a real arm, for longer in the simulator.
places = [-16 40 -40 40 -25 30];

robot = robot_connect();

% The open jaws are at the end of their travel, and on their switch. It opens when they close.
robot_changes(robot, 'A', -10, 1600);
closed = robot_switch(robot, 'A');  % the reading of a closed switch, 0 or 1

% A shoulder on its switch may lean far back: it comes forward before the forearm moves.
if robot_switch(robot, 'E') == closed, robot_find_edge(robot, 'E', -1, closed); end

for k = 1:6
  joint = joints(k);
  if ~robot_find_edge(robot, joint, sign(places(k)), closed)
    error(['the switch of %s does not change. Is the joint blocked at a limit, or the arm ' ...
           'stalled? Is the clock paused? (The examples 3 to 6 are for the Rhino XR-3 with its ' ...
           'own workcell)\n'], joint);
  end
  fprintf('%s is on its switch, at %+d\n', joint, places(k));
end

% All switches at once. J also reports four input lines, in its bits 1 to 8.
i = robot_ask(robot, 'I') - 32;
j = bitand(robot_ask(robot, 'J') - 32, 48);
fprintf('a closed switch reads %d; the switches of I are %d, those of J %d\n', closed, i, j);

% The soft home is at count 0: move each joint back by the count of its switch.
for k = 1:6
  robot_send(robot, '%s%+d\r', joints(k), -places(k));
  left = robot_wait(robot, joints(k));
  if left > 0, robot_stands(joints(k), left); end
end
fprintf('at the soft home\n');

clear robot
