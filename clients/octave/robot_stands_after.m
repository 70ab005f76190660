function questions = robot_stands_after()
% A joint stands if its counter is the same after so many questions, in 2 seconds. The slowest speed
% is one count a second, and the simulator's clock may run slowly, so be patient.
  questions = 40;
end
