% 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
% switch that closes at a known position. Searching for it tells where the joint is.
%
%     octave-cli ex3_home.m [HOST [PORT]]

% The elbow comes first, since it lifts the hand off the table; the jaws, joint A, come last.
joints = 'DECBFA';

% Where the switches close, in counts from the soft home: upper arm upright, forearm level, tool
% down. Seen from there each is open before this count, and closed from it on: for a few dozen
% counts on a real arm, for longer in the simulator.
places = [40 -40 40 -25 30 16];

robot = robot_connect();
closed = [];  % what a closed switch reads, 0 or 1: not known until the first one has changed

for k = 1:6
  joint = joints(k);
  if ~robot_find_edge(robot, joint, sign(places(k)), closed)
    error(['the switch of %s does not change. Is the joint blocked at a limit, or the arm ' ...
           'stalled? Is the clock paused? (The examples 3 to 6 are for the Rhino XR-3 with its ' ...
           'own workcell)\n'], joint);
  end
  closed = robot_switch(robot, joint);
  fprintf('%s is on its switch, at %+d\n', joint, places(k));
end

% All switches at once. J also reports four input lines, in its bits 4 to 32.
i = robot_ask(robot, 'I') - 32;
j = mod(robot_ask(robot, 'J') - 32, 4);
fprintf('a closed switch reads %d; the switches of I are %d, those of J %d\n', closed, i, j);

% The soft home is at count 0: move each joint back by the count of its switch.
for k = 1:6
  robot_send(robot, '%s%+d\r', joints(k), -places(k));
  left = robot_wait(robot, joints(k));
  if left > 0, robot_stands(joints(k), left); end
end
fprintf('at the soft home\n');

clear robot
