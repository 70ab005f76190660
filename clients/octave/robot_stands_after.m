function questions = robot_stands_after()
% A joint counts as stopped if its counter is the same after this many questions, over 2 seconds.
% The slowest speed is one count per second, and the simulator's clock may run slowly, hence the
% long wait.
  questions = 40;
end
