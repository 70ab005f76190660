// The command line of xr3 for tests: words in, options out; and an environment that is as before when
// a test ends.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "server/options.hpp"

namespace xr3::test {

/// `xr3 WORDS...`
Options parse(std::initializer_list<const char*> words);

/// The refusal of what must be refused.
Leave refused(std::initializer_list<const char*> words);

/// Variables that are set while it lives.
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
