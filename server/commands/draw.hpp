// `xr3 draw OUT`: writes the wire frame of a robot and its workcell to a picture file.
#pragma once

#include "server/options/options.hpp"

namespace xr3 {

/// Writes SVG if the name ends in .svg, else PNG. Throws FileError, DataError or ArgumentError.
ExitCode draw(const DrawOptions& options);

}  // namespace xr3
