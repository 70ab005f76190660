function changed = robot_changes(robot, joint, counts, farthest)
% Moves in steps of `counts` until the joint's switch changes. Returns false if it does not within
% `farthest` counts, or before the joint is blocked.
  before = robot_switch(robot, joint);
  changed = false;
  left = 0;
  gone = 0;
  while ~changed && left == 0 && gone < farthest
    robot_send(robot, '%s%+d\r', joint, counts);
    left = robot_wait(robot, joint);  % as in example 2; cancels the move of a blocked joint
    gone = gone + abs(counts);
    changed = robot_switch(robot, joint) ~= before;
  end
end
