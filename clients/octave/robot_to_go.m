function left = robot_to_go(robot, joint)
% How many counts the joint has still to go.
  left = robot_ask(robot, [joint '?']) - 32;
end
