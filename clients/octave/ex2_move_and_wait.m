% 2. Move and wait: move a joint and ask until it has arrived.
%
%     octave-cli ex2_move_and_wait.m [HOST [PORT]]

robot = robot_connect();

% Turn the shoulder by 50 counts of its encoder. The carriage return ends the number.
fprintf('E+50\n');
robot_send(robot, 'E+50\r');

% The robot starts to move and does not answer, so ask for the remaining counts until none are left,
% with a pause between two questions. A blocked joint would never finish, so give up after a number
% of equal answers.
left = robot_to_go(robot, 'E');
same = 0;
while left > 0
  fprintf('  %d counts to go\n', left);
  robot_pause();
  before = left;
  left = robot_to_go(robot, 'E');
  if left == before, same = same + 1; else, same = 0; end
  if same == robot_stands_after()
    robot_send(robot, 'EX');  % cancels the rest of the move
    robot_stands('E', left);
  end
end
fprintf('E is there\n');

% Move back.
fprintf('E-50\n');
robot_send(robot, 'E-50\r');
left = robot_to_go(robot, 'E');
same = 0;
while left > 0
  fprintf('  %d counts to go\n', left);
  robot_pause();
  before = left;
  left = robot_to_go(robot, 'E');
  if left == before, same = same + 1; else, same = 0; end
  if same == robot_stands_after()
    robot_send(robot, 'EX');  % cancels the rest of the move
    robot_stands('E', left);
  end
end
fprintf('E is there\n');

clear robot
