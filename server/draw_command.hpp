// `xr3 draw OUT`: the wire frame of a robot and its workcell as a picture file.
#pragma once

#include "server/options.hpp"

namespace xr3 {

/// Writes the picture, SVG or PNG as the file's name ends. Throws FileError, DataError, ArgumentError.
ExitCode draw(const DrawOptions& options);

}  // namespace xr3
