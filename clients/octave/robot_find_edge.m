function found = robot_find_edge(robot, joint, away, closed)
% Moves to the count at which the joint's switch closes. `away` is 1 or -1, the direction from the
% soft home to the switch; `closed` is what a closed switch reads, or [] if that is not known.
% Returns false if the switch does not change.
  step = 10;     % counts of one move of the search; a switch stays closed for longer
  widest = 100;  % more counts than a switch of a real arm stays closed
  far = 1600;    % more counts than any joint has from a limit to its switch

  % How far to search away from the soft home before trying the other direction. The shoulder must
  % not lean far back, or the hand hits the base.
  reach = far;
  if joint == 'E', reach = 60; end

  % Watch the switch change, at whichever edge: first in one direction, then in the other. If it
  % reads like the closed ones before, the near edge lies towards the soft home.
  way = away;
  if any(robot_switch(robot, joint) == closed)
    way = -away;
    reach = far;
  end
  found = robot_changes(robot, joint, step * way, reach) || ...
          robot_changes(robot, joint, -step * way, 2 * far) || ...
          robot_changes(robot, joint, step * way, 2 * far);
  if ~found, return; end

  % Move towards the soft home until the switch has not changed for a long way: now it is open.
  while robot_changes(robot, joint, -step * away, widest)
  end

  % Quickly up to the near edge, back again, and then count by count.
  found = robot_changes(robot, joint, step * away, far) && ...
          robot_changes(robot, joint, -step * away, far) && ...
          robot_changes(robot, joint, away, far);
end
