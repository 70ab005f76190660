// `xr3 kin`: the arithmetic of a robot at the desk, direct and inverse.
#pragma once

#include "server/options.hpp"

namespace xr3 {

/// The report goes to standard output. kBadInput, with a sentence on standard error, if the options
/// make no question or the pose cannot be had; JSON is written in the latter case too.
ExitCode show_kinematics(const KinOptions& options);

}  // namespace xr3
