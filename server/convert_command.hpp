// `xr3 convert IN OUT`: a robot or workcell file from JSON to the paper's plain form, or back.
#pragma once

#include "server/options.hpp"

namespace xr3 {

/// The form of IN is told by its content, that of OUT by its ending: .json, or .txt or .dat for the
/// plain form. What is found in IN goes to standard error; kBadInput if there is an error, if OUT has
/// another ending, or if it is there already and `force` is not given. Throws FileError.
ExitCode convert_file(const ConvertOptions& options);

}  // namespace xr3
