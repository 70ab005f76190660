function robot_pause()
% Pauses between two questions: 50 ms, or XR3_POLL_MS.
  milliseconds = str2double(getenv('XR3_POLL_MS'));
  if isnan(milliseconds), milliseconds = 50; end
  pause(milliseconds / 1000);
end
