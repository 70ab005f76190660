# Inverse kinematics: converts a place on the table (x and y in mm, angle in degrees) and a height z
# to motor counts, with the tool pointing down.
#
# Seen from the side, upper arm and forearm, 228.6 mm each, are two sides of a triangle. The third
# side leads from the shoulder, 260.4 mm above the table, to the wrist, 168.3 mm above the tip and
# 9.5 mm nearer to the base. Each motor sets the slope of one link, independently of the others.

function nearest(number) { return number < 0 ? int(number - 0.5) : int(number + 0.5) }

BEGIN {
  degrees = 180 / atan2(0, -1)
  out = sqrt(x * x + y * y) - 9.5
  up = z + 168.3 - 260.4
  base = atan2(y, x) * degrees
  slope = atan2(up, out) * degrees
  side = sqrt(out * out + up * up) / 2 / 228.6
  corner = atan2(sqrt(1 - side * side), side) * degrees # awk has no arc cosine
  upper_arm = slope + corner
  forearm = slope - corner
  # A block looks the same after half a turn, so the roll can be reduced to -90...90.
  roll = base - angle + 90
  roll -= 180 * nearest(roll / 180)
  print "F", nearest(base / 0.2269), "E", nearest((90 - upper_arm) / 0.1135), \
        "D", nearest(forearm / 0.1135), "C", 0, "B", nearest(roll / 0.3125)
}
