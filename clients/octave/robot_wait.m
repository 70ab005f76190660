function left = robot_wait(robot, joint)
% Waits until the joint is there. One that stands, at a limit or with the jaws at a block, is
% stopped. Returns the counts that were left.
  left = robot_to_go(robot, joint);
  same = 0;  % how many answers in a row have been the same
  while left > 0 && same < robot_stands_after()
    pause(0.05);
    before = left;
    left = robot_to_go(robot, joint);
    if left == before, same = same + 1; else, same = 0; end
  end
  if left > 0
    robot_send(robot, '%sX', joint);
  end
end
