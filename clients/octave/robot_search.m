function robot_search(robot, joint, counts, closed)
% Moves in steps of `counts` until the joint's switch is closed (true) or open (false).
  farthest = 2500;  % more counts than the full travel of any joint
  gone = 0;
  while (robot_ask(robot, [joint 'V']) == 1) ~= closed  % 0 or 1, without the 32
    robot_send(robot, '%s%+d\r', joint, counts);
    left = robot_wait(robot, joint);  % as in example 2; cancels the move of a blocked joint
    gone = gone + abs(counts) - left;
    if left == abs(counts) || gone > farthest
      error(['%s went %d counts and found no switch. Is it blocked at a limit, or stalled? Is ' ...
             'the clock paused? (The examples 3 to 6 are for the Rhino XR-3 with its own ' ...
             'workcell, in the profile paper)\n'], joint, gone);
    end
  end
end
