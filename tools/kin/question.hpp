// The question of an `xr3 kin` command: converts the numbers of its options to a checked question
// for the direct or the inverse kinematics. It neither solves it nor reads the command line.
#pragma once

#include <optional>
#include <stdexcept>
#include <variant>
#include <vector>

#include "core/inverse/inverse.hpp"

namespace xr3 {

/// The options as given; a list that was not given is empty.
struct KinOptionValues {
  std::vector<double> joints;  ///< variables from the base, degrees and mm; optionally the tool's
  std::vector<double> counts;  ///< motor counts from the base; optionally the tool's
  std::vector<double> pose;    ///< x, y, z in mm; optionally yaw, pitch, roll in degrees
  std::vector<double> configuration;  ///< w1...w6
  std::vector<double> approach;       ///< with x, y, z: a vector of any length
  std::optional<double> down;         ///< with x, y, z: net roll in degrees, the tool straight down
  std::optional<double> roll;         ///< with an approach: the last joint's variable
  std::optional<double> tool;         ///< the tool's variable, degrees or mm
  std::optional<double> slide;        ///< with a target: the place of the slide, mm
  InverseOptions tolerance;
};

/// Direct kinematics: where is the tool?
struct DirectQuestion {
  JointVariables variables;
  double tool = 0;  ///< degrees or mm
};

/// Inverse kinematics: which joint variables bring the tool to the target?
struct InverseQuestion {
  ToolTarget target;
  InverseOptions options;
};

using KinQuestion = std::variant<DirectQuestion, InverseQuestion>;

/// The options contradict each other or do not suit the robot. The message says what to give
/// instead.
class KinQuestionError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Throws KinQuestionError.
KinQuestion kin_question(const Model& model, const KinOptionValues& values);

}  // namespace xr3
