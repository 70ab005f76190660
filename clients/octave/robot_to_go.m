function left = robot_to_go(robot, joint)
% The counts that the joint still has to go.
  left = robot_ask(robot, [joint '?']) - 32;
end
