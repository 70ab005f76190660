// Parses command lines of xr3 for tests, and restores the environment at the end of a test.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "cli/options/options.hpp"

namespace xr3::test {

/// `xr3 WORDS...`
Options parse(std::initializer_list<const char*> words);

/// The exception for a command line that must be refused.
Leave refused(std::initializer_list<const char*> words);

/// Sets environment variables during its lifetime.
class Environment {
 public:
  explicit Environment(std::vector<std::pair<std::string, std::string>> variables);
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment();

 private:
  std::vector<std::pair<std::string, std::string>> variables_;
};

}  // namespace xr3::test
