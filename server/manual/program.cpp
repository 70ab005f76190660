#include "server/manual/program.hpp"

#include <algorithm>

namespace xr3 {

const DescribedCommand* find_command(const DescribedProgram& program, const std::string& name) {
  const auto found = std::find_if(program.commands.begin(), program.commands.end(),
                                  [&](const DescribedCommand& c) { return c.name == name; });
  return found == program.commands.end() ? nullptr : &*found;
}

}  // namespace xr3
