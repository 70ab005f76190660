// `xr3 grade`: runs every submission of a class, and writes a report with a page.
#pragma once

#include "server/exit_code.hpp"
#include "server/options/options.hpp"

namespace xr3 {

/// Returns kGood when every submission was run, whatever it scored. Throws FileError, DataError and
/// std::system_error.
ExitCode grade_submissions(const GradeCommand& command);

}  // namespace xr3
