function robot_search(robot, joint, counts, closed)
% Steps of so many counts until the joint's switch is as wanted: closed (true) or open (false).
  farthest = 2500;  % no joint has so many counts to go from one end of its way to the other
  gone = 0;
  while (robot_ask(robot, [joint 'V']) == 1) ~= closed  % a plain 0 or 1, nothing is added
    robot_send(robot, '%s%+d\r', joint, counts);
    left = robot_wait(robot, joint);  % asks as in example 2, and stops a joint that stands
    gone = gone + abs(counts) - left;
    if left == abs(counts) || gone > farthest
      error(['%s went %d counts and found no switch. Is it blocked at a limit, or stalled? Does ' ...
             'time stand? (The examples 3 to 6 are for the Rhino XR-3 with its own workcell, in ' ...
             'the profile paper)\n'], joint, gone);
    end
  end
end
