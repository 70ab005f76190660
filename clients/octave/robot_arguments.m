function words = robot_arguments()
% The words after the program's name on Octave's command line. This file has all that Octave needs
% and MATLAB does not: there sockets are built in, and programs have no arguments.
  words = {};
  if exist('OCTAVE_VERSION', 'builtin')
    pkg('load', 'instrument-control');
    words = argv();
    if any(strncmp(words, '-', 1)), words = {}; end  % at Octave's prompt: its own options
    % Without a folder for its history, Octave would print an error at the end.
    if ~exist(fileparts(fileparts(history_file())), 'dir'), history_save(false); end
  end
end
