// `xr3 manual --write FOLDER`.
#pragma once

#include "server/exit_code.hpp"
#include "server/options/options.hpp"

namespace xr3 {

/// Writes the files and prints their number. Replaces files of the same names. Throws FileError.
ExitCode write_manual(const ManualFiles& manual);

}  // namespace xr3
