function counts = counts_at(place, z)
% Inverse kinematics: the counts of base, shoulder, elbow, pitch and roll for a place on the table
% (x and y in mm, angle in degrees) at height z, with the tool pointing down.
%
% Seen from the side, upper arm and forearm, 228.6 mm each, are two sides of a triangle. The third
% side leads from the shoulder, 260.4 mm above the table, to the wrist, 168.3 mm above the tip and
% 9.5 mm nearer to the base. Each motor sets the slope of one link, independently of the others.
  degrees = 180 / pi;
  out = hypot(place.x, place.y) - 9.5;
  up = z + 168.3 - 260.4;
  base = atan2(place.y, place.x) * degrees;
  slope = atan2(up, out) * degrees;
  corner = acos(hypot(out, up) / 2 / 228.6) * degrees;
  upper_arm = slope + corner;
  forearm = slope - corner;
  % A block looks the same after half a turn, so the roll can be reduced to -90...90.
  roll = base - place.angle + 90;
  roll = roll - 180 * round(roll / 180);
  counts = round([base / 0.2269, (90 - upper_arm) / 0.1135, forearm / 0.1135, 0, roll / 0.3125]);
end
