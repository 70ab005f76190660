function left = robot_wait(robot, joint)
% Waits until the joint has arrived. If it is blocked (at a limit, or jaws at a block), cancels its
% move. Returns the counts that were left.
  left = robot_to_go(robot, joint);
  same = 0;  % number of equal answers in a row
  while left > 0 && same < robot_stands_after()
    robot_pause();
    before = left;
    left = robot_to_go(robot, joint);
    if left == before, same = same + 1; else, same = 0; end
  end
  if left > 0
    robot_send(robot, '%sX', joint);
  end
end
