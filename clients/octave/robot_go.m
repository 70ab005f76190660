function robot = robot_go(robot, wanted)
% Moves the motors to these counts together, in parts small enough for the error counter. The counts
% are those of base, shoulder, elbow, pitch, roll and, optionally, the jaws. Usage:
%     robot = robot_go(robot, [0 0 0 0 0]);
  start = robot.at;
  moving = 1:numel(wanted);
  parts = ceil(max(abs(wanted - start(moving))) / 60);  % no move is longer than 60 counts
  for part = 1:parts
    next = start;
    next(moving) = start(moving) + round((wanted - start(moving)) * part / parts);
    for j = moving
      if next(j) ~= robot.at(j)
        robot_send(robot, '%s%+d\r', robot.joints(j), next(j) - robot.at(j));
      end
    end
    for j = moving
      left = robot_wait(robot, robot.joints(j));
      if left > 0, robot_stands(robot.joints(j), left); end
    end
    robot.at = next;
  end
end
