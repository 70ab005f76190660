// `xr3 convert IN OUT`: converts a robot or workcell file to the paper's plain form or to JSON.
#pragma once

#include "server/options/options.hpp"

namespace xr3 {

/// The content of IN determines its form; the extension of OUT determines the new one: .json, or
/// .txt or .dat for the plain form. Findings in IN go to standard error. Returns kBadInput if IN
/// has an error, if OUT has another extension, or if OUT exists and `force` is not set. Throws
/// FileError.
ExitCode convert_file(const ConvertOptions& options);

}  // namespace xr3
