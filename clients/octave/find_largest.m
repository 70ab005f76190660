function place = find_largest(robot)
% Takes a picture and returns the place of the largest block: x and y of its centre in mm, and the
% angle of its long side in degrees.
%
% The camera looks straight down on a square of 384 mm centred at x 290, y 0, with 192 x 192 pixels
% of 2 mm.
  pixels = 192;

  % The picture: rows from the top, six pixels per byte, the leftmost in the highest bit, plus 32.
  robot_send(robot, 'A**');
  bytes = double(read(robot.line, pixels * pixels / 6)) - 32;
  if numel(bytes) ~= pixels * pixels / 6
    error('%s\n', 'the robot sent an incomplete picture');
  end
  six = zeros(6, numel(bytes));
  for bit = 1:6
    six(bit, :) = bitget(bytes, 7 - bit);
  end
  picture = reshape(six, pixels, pixels)';  % picture(row, column)

  % Takes one patch of connected ones after the other and keeps the largest.
  patches = 0;
  largest = [];
  while any(picture(:))
    [picture, patch] = take_patch(picture);
    patches = patches + 1;
    if size(patch, 1) > size(largest, 1)
      largest = patch;
    end
  end
  fprintf('blocks in the picture: %d\n', patches);
  if patches == 0
    error('%s\n', 'the camera sees no block: is one on the table?');
  end

  % The centre is the average of the pixels. The long side has the direction of their largest
  % spread, the principal axis of inertia.
  x = 290 - 192 + 2 * (largest(:, 2) - 0.5);
  y = 0 + 192 - 2 * (largest(:, 1) - 0.5);
  place.x = mean(x);
  place.y = mean(y);
  xx = mean((x - place.x) .^ 2);
  yy = mean((y - place.y) .^ 2);
  xy = mean((x - place.x) .* (y - place.y));
  place.angle = mod(atan2(2 * xy, xx - yy) / 2 * 180 / pi, 180);
  fprintf('the largest is at x %.0f, y %.0f mm, turned %.0f degrees\n', ...
          place.x, place.y, place.angle);
end

function [picture, patch] = take_patch(picture)
% Removes the first pixel that is 1, and all pixels connected to it, from the picture. A row of
% `patch` is [row column] of a pixel.
  [row, column] = find(picture, 1);
  picture(row, column) = 0;
  patch = [row column];
  next = 1;
  while next <= size(patch, 1)  % the patch grows in this loop
    for step = [0 0 1 -1; 1 -1 0 0]
      row = patch(next, 1) + step(1);
      column = patch(next, 2) + step(2);
      inside = row >= 1 && row <= size(picture, 1) && column >= 1 && column <= size(picture, 2);
      if inside && picture(row, column)
        picture(row, column) = 0;
        patch(end + 1, :) = [row column];
      end
    end
    next = next + 1;
  end
end
