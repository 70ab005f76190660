# Finds the largest block in the camera's picture. Each input line is a row of the picture, from the
# top, its bytes as numbers. Prints the number of blocks and, for the largest, x and y of its centre
# in mm and the angle of its long side in degrees.
#
# The camera looks straight down on a square of 384 mm centred at x 290, y 0, with 192 x 192 pixels
# of 2 mm.

# A byte has six pixels, the leftmost in the highest bit, plus 32.
{
  for (i = 1; i <= NF; i++) {
    six = $i - 32
    for (column = 6 * i; column > 6 * (i - 1); column--) {
      if (six % 2 == 1) ones[NR, column] = 1
      six = int(six / 2)
    }
  }
}

# Removes this pixel and all pixels connected to it from the picture, so that none is counted twice,
# and sums their positions. (It keeps a list of pixels whose neighbours are to be checked, since
# recursion would be too deep for some awks.)
function collect(row, column,    first, last, place, px, py) {
  n = sx = sy = sxx = syy = sxy = 0
  first = last = 1
  list[1] = row SUBSEP column
  delete ones[row, column]
  while (first <= last) {
    split(list[first++], place, SUBSEP)
    px = 290 - 192 + 2 * (place[2] - 0.5)
    py = 0 + 192 - 2 * (place[1] - 0.5)
    n++
    sx += px
    sy += py
    sxx += px * px
    syy += py * py
    sxy += px * py
    last = append(place[1], place[2] + 1, last)
    last = append(place[1], place[2] - 1, last)
    last = append(place[1] + 1, place[2], last)
    last = append(place[1] - 1, place[2], last)
  }
}

function append(row, column, last) {
  if (!((row, column) in ones)) return last
  delete ones[row, column]
  list[last + 1] = row SUBSEP column
  return last + 1
}

END {
  for (row = 1; row <= NR; row++) {
    for (column = 1; column <= 192; column++) {
      if (!((row, column) in ones)) continue
      collect(row, column)
      patches++
      if (n <= most) continue
      most = n
      # The centre is the average of the pixels. The long side has the direction of their largest
      # spread, the principal axis of inertia.
      x = sx / n
      y = sy / n
      angle = atan2(2 * (sxy / n - x * y), (sxx / n - x * x) - (syy / n - y * y)) / 2
      angle *= 180 / atan2(0, -1)
      if (angle < 0) angle += 180
    }
  }
  print patches + 0, x, y, angle
}
