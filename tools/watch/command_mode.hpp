// Command mode of `xr3 watch` (paper, Table IV): the functions on Alt F1...F6, a menu of them, and
// a plain letter for each, since many terminals and desktops keep the Alt keys. Keys in, functions
// to run out; independent of the terminal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/watch/watched_cell.hpp"

namespace xr3::watch {

/// A key: a character, or function key F`function` (1...12). Any other key has neither.
struct ModeKey {
  char letter = 0;
  int function = 0;
  bool is_alt = false;
  bool operator==(const ModeKey&) const = default;
};

/// The call `key` of the monitor port: a function, and its value if it takes one.
struct FunctionCall {
  std::string function;
  std::vector<std::int64_t> value;
  bool operator==(const FunctionCall&) const = default;
};

class CommandMode {
 public:
  /// Whether the key belonged to command mode, and the function to run because of it. Alt F1...F5
  /// do nothing while the function keys are off, as in the paper; the letters always work.
  struct KeyResult {
    bool is_taken = false;
    std::optional<FunctionCall> call;
  };
  KeyResult press(const ModeKey& key, const std::optional<Display>& display);

  bool is_menu_open() const { return is_menu_open_; }
  /// The current question to the user, with the input so far; empty if there is none.
  std::string prompt() const;

 private:
  KeyResult press_in_prompt(const ModeKey& key);

  bool is_menu_open_ = false;
  std::optional<std::size_t> asked_;  ///< index of the function whose value is being typed
  std::string typed_;
  bool is_wrong_ = false;  ///< the last input was invalid for the function
};

/// The lines of the menu: key, name and value of each function.
std::vector<std::string> menu_lines(const std::optional<Display>& display, bool is_enabled);

}  // namespace xr3::watch
