function value = robot_switch(robot, joint)
% The bit of the joint's switch, 0 or 1. Some controllers report a closed switch as 1, others as 0.
% One byte reports several switches: I those of joints C to F, J those of A and B. Each has one bit.
  numbers = [5 6 1 2 3 4];  % of the bits for A, B, C, D, E and F; bit 1 has the value 1
  inquiry = 'I';
  if any(joint == 'AB'), inquiry = 'J'; end
  value = bitget(robot_ask(robot, inquiry) - 32, numbers(joint - 'A' + 1));
end
