% 2. Move and wait: send a joint somewhere, and ask until it has arrived.
%
%     octave-cli 2_move_and_wait.m [HOST [PORT]]

robot = robot_connect();

% The shoulder shall turn by 50 counts of its encoder. The carriage return tells the robot that the
% number ends here.
fprintf('E+50\n');
robot_send(robot, 'E+50\r');

% It starts to move, and answers nothing: so we ask how far there is still to go, until nothing is
% left. Between two questions we do nothing for a while. A joint that is blocked would let us ask
% forever: we give up after so many questions with the same answer.
left = robot_to_go(robot, 'E');
same = 0;
while left > 0
  fprintf('  %d counts to go\n', left);
  pause(0.05);
  before = left;
  left = robot_to_go(robot, 'E');
  if left == before, same = same + 1; else, same = 0; end
  if same == robot_stands_after()
    robot_send(robot, 'EX');  % forgets the rest of the move
    robot_stands('E', left);
  end
end
fprintf('E is there\n');

% And back again.
fprintf('E-50\n');
robot_send(robot, 'E-50\r');
left = robot_to_go(robot, 'E');
same = 0;
while left > 0
  fprintf('  %d counts to go\n', left);
  pause(0.05);
  before = left;
  left = robot_to_go(robot, 'E');
  if left == before, same = same + 1; else, same = 0; end
  if same == robot_stands_after()
    robot_send(robot, 'EX');  % forgets the rest of the move
    robot_stands('E', left);
  end
end
fprintf('E is there\n');

clear robot
