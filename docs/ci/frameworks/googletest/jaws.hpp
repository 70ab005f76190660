// The code under test: closes the jaws, and measures what is between them.
#pragma once

#include "robot.hpp"

/// Closes the jaws. Returns the width of what they hold in mm; 0 if they hold nothing.
inline double close_jaws(Robot& robot) {
  const int shut = 64;  // count at which they are closed
  const double open_mm = 50.8;
  robot.send("A+90\r");
  robot.at['A'] += 90 - robot.wait('A');
  return robot.at['A'] < shut ? open_mm - open_mm / shut * robot.at['A'] : 0;
}
