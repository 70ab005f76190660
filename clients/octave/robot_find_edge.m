function found = robot_find_edge(robot, joint, away, closed)
% Moves to the count at which the joint's switch closes. `away` is 1 or -1, the direction from the
% soft home to the switch; `closed` is what a closed switch reads. Returns false if the switch does
% not change.
  step = 10;   % counts of one move of the search; a switch stays closed for longer
  far = 1600;  % more counts than any joint has from a limit to its switch

  % Back until the switch opens, and then count by count until it closes.
  found = (robot_switch(robot, joint) == closed || search(robot, joint, away, step, far)) && ...
          robot_changes(robot, joint, -step * away, far) && ...
          robot_changes(robot, joint, away, far);
end

function found = search(robot, joint, away, step, far)
% Moves until the switch closes, usually away from the soft home first. Returns false if it does not
% close.
  lean = 400;  % counts forward that bring the shoulder out of its backmost position
  if joint == 'E'  % forwards first: a shoulder that leans back folds the arm into its base
    found = robot_changes(robot, 'E', step, lean) || robot_changes(robot, 'E', -step, 2 * far);
    return
  end
  found = robot_changes(robot, joint, step * away, far);
  if found, return; end
  % The shoulder may lean far back: it must not when the forearm comes down.
  if joint == 'D', robot_changes(robot, 'E', step, lean); end
  found = robot_changes(robot, joint, -step * away, 2 * far);
end
