function left = robot_wait(robot, joint)
% Waits until the joint is there. One that makes no count between two questions stands, at a limit
% or with the jaws at a block, and is stopped. Returns the counts that were left.
  left = robot_to_go(robot, joint);
  while left > 0
    pause(0.05);  % time enough for a count at 20 counts a second and more
    before = left;
    left = robot_to_go(robot, joint);
    if left == before
      robot_send(robot, '%sX', joint);
      break
    end
  end
end
