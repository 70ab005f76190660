// Loads a robot and a workcell from their files, and goals for them.
#pragma once

#include <optional>
#include <string>

#include "core/model.hpp"
#include "protocol/goals/goal.hpp"
#include "server/base/option_sources.hpp"

namespace xr3 {

struct ModelFiles {
  std::string robot;     ///< name or path
  std::string workcell;  ///< name or path; empty for the one with the robot's name, or kNoWorkcell
  Profile profile = Profile::kPaper;
  OptionSources option_sources = {};  ///< sources of the names of the files, for messages
};

/// Loads robot and workcell, each in either form. kNoWorkcell is an empty table for the robot, and
/// the default if no workcell has the robot's name. Throws FileError and DataError.
ModelPtr load_model(const ModelFiles& files);

/// The robot with the name of a workcell file, if there is one: blocks are checked against it.
/// Throws FileError and DataError.
std::optional<Robot> robot_with_name_of(const std::string& workcell_file);

/// The goals of a file: a name or a path. Throws FileError and DataError.
GoalList load_goal_list(const std::string& file, const Model& model);

}  // namespace xr3
