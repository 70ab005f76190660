// Manual pages, section 1, in the macros of man(7).
#pragma once

#include <string>

#include "cli/manual/program.hpp"

namespace xr3 {

/// The page of the program, xr3(1).
std::string man_page(const DescribedProgram& program);

/// The page of one of its commands, such as xr3-serve(1).
std::string man_page(const DescribedProgram& program, const DescribedCommand& command);

}  // namespace xr3
