// The program under test: turns the base and the shoulder. XR3_HOST and XR3_PORT name the robot.

#include <exception>
#include <iostream>

#include "robot.hpp"

int main(int argc, char* argv[]) try {
  Robot robot(argc, argv);
  robot.go({{'F', 40}, {'E', 140}});
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
