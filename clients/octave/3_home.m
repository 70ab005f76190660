% 3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
% switch that closes at one place of its way. Looking for that place is how a robot finds out.
%
%     octave-cli 3_home.m [HOST [PORT]]

% Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool down.
% The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
joints = 'DECBFA';
places = [40 -40 40 -25 30 16];

robot = robot_connect();
is_closed = @(joint) robot_ask(robot, [joint 'V']) == 1;  % a plain 0 or 1, nothing is added

for k = 1:6
  joint = joints(k);
  way = sign(places(k));
  while ~is_closed(joint)  % quickly, until the switch closes
    robot_send(robot, '%s%+d\r', joint, 5 * way);
    robot_wait(robot, joint);  % asks as in example 2, and stops a joint that cannot go on
  end
  while is_closed(joint)  % back, until it opens again
    robot_send(robot, '%s%+d\r', joint, -way);
    robot_wait(robot, joint);
  end
  while ~is_closed(joint)  % slowly: now we know to the count where it closes
    robot_send(robot, '%s%+d\r', joint, way);
    robot_wait(robot, joint);
  end
  fprintf('%s stands on its switch, at %+d\n', joint, places(k));
end

% All switches at once: I tells of joints C to F, J of A and B.
i = robot_ask(robot, 'I') - 32;
j = robot_ask(robot, 'J') - 32;
fprintf('switches closed: %d of I, %d of J\n', i, j);

% From here the soft home is as far away as the switches are from it.
for k = 1:6
  robot_send(robot, '%s%+d\r', joints(k), -places(k));
  robot_wait(robot, joints(k));
end
fprintf('at the soft home\n');

clear robot is_closed
