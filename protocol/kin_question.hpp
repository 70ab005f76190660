// What is asked of `xr3 kin`, from the numbers of its options to a checked question for the direct or
// the inverse kinematics. It solves nothing and reads no command line.
#pragma once

#include <optional>
#include <stdexcept>
#include <variant>
#include <vector>

#include "core/inverse.hpp"

namespace xr3 {

/// The options as they were given; a list that was not given is empty.
struct KinOptionValues {
  std::vector<double> joints;  ///< variables from the base, degrees and mm; then the tool's
  std::vector<double> counts;  ///< motor counts from the base; then the tool's
  std::vector<double> pose;    ///< x, y, z in mm, then yaw, pitch, roll in degrees, or no more
  std::vector<double> configuration;  ///< w1...w6
  std::vector<double> approach;       ///< with x, y, z: a vector of any length
  std::optional<double> down;         ///< with x, y, z: net roll in degrees, the tool straight down
  std::optional<double> roll;         ///< with an approach: the last joint's variable
  std::optional<double> tool;         ///< the tool's variable, degrees or mm
  InverseOptions tolerance;
};

/// Where is the tool?
struct DirectQuestion {
  JointVariables variables;
  double tool = 0;  ///< degrees or mm
};

/// Which joint variables bring it there?
struct InverseQuestion {
  ToolTarget target;
  InverseOptions options;
};

using KinQuestion = std::variant<DirectQuestion, InverseQuestion>;

/// The options contradict each other or the robot; the message says what to give instead.
class KinQuestionError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Throws KinQuestionError.
KinQuestion kin_question(const Model& model, const KinOptionValues& values);

}  // namespace xr3
