#include "tests/support/command_line.hpp"

#include <cstdlib>

namespace xr3::test {

Options parse(std::initializer_list<const char*> words) {
  std::vector<const char*> argv{"xr3"};
  argv.insert(argv.end(), words);
  return parse_options(static_cast<int>(argv.size()), argv.data());
}

Leave refused(std::initializer_list<const char*> words) { return std::get<Leave>(parse(words)); }

Environment::Environment(std::vector<std::pair<std::string, std::string>> variables)
    : variables_(std::move(variables)) {
  for (const auto& [name, value] : variables_) ::setenv(name.c_str(), value.c_str(), 1);
}

Environment::~Environment() {
  for (const auto& [name, value] : variables_) ::unsetenv(name.c_str());
}

}  // namespace xr3::test
