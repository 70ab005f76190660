function left = robot_to_go(robot, joint)
% The counts that the joint still has to go. A Mark III answers with seven bits: for more than 95
% counts the answer is wrong there, so no move of these programs is longer.
  left = robot_ask(robot, [joint '?']) - 32;
end
