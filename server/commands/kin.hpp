// `xr3 kin`: forward and inverse kinematics of a robot.
#pragma once

#include "server/options/options.hpp"

namespace xr3 {

/// Writes the report to standard output. Returns kBadInput, with a sentence on standard error, if
/// the options are invalid or the pose is unreachable; --json writes the report in the latter
/// case, too.
ExitCode show_kinematics(const KinOptions& options);

}  // namespace xr3
