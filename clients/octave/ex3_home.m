% 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
% switch that closes at a known position. Searching for it tells where the joint is.
%
%     octave-cli ex3_home.m [HOST [PORT]]

% Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool down.
% The elbow comes first, since it lifts the hand off the table; the jaws, joint A, come last.
joints = 'DECBFA';
places = [40 -40 40 -25 30 16];

robot = robot_connect();

% Some controllers report their switches inverted. The answer to I shows it: the highest of its six
% bits belongs to no switch and should be 0.
if robot_ask(robot, 'I') - 32 >= 32
  error('%s\n', ['the switches of D and of all other joints read 1 when they are open, as in ' ...
                 'the profile mark3. This example is for the profile paper']);
end

for k = 1:6
  joint = joints(k);
  way = sign(places(k));
  robot_search(robot, joint, 5 * way, true);    % quickly, until the switch closes
  robot_search(robot, joint, -5 * way, false);  % back, until it opens again
  robot_search(robot, joint, way, true);        % slowly, to find the exact count at which it closes
  fprintf('%s is on its switch, at %+d\n', joint, places(k));
end

% All switches at once: I reports joints C to F, J reports A and B.
i = robot_ask(robot, 'I') - 32;
j = robot_ask(robot, 'J') - 32;
fprintf('switches closed: %d of I, %d of J\n', i, j);

% The soft home is at count 0: move each joint back by the count of its switch.
for k = 1:6
  robot_send(robot, '%s%+d\r', joints(k), -places(k));
  left = robot_wait(robot, joints(k));
  if left > 0, robot_stands(joints(k), left); end
end
fprintf('at the soft home\n');

clear robot
