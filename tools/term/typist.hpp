// Keys that are sent at once: which of them go to the robot, which are escapes, and the echo that
// the terminal shows, because the controller does not echo.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/term/keystroke.hpp"
#include "tools/term/request.hpp"

namespace xr3::term {

class Typist {
 public:
  struct TypingResult {
    std::string echo;  ///< to print; \n ends a line
    std::vector<UserRequest> requests;
    bool operator==(const TypingResult&) const = default;
  };

  TypingResult press(const Keystroke& key);

  /// Notes that the terminal has begun a new line, below a reply. An escape may follow.
  void begin_line();

 private:
  enum class TypingMode : std::uint8_t {
    kLineStart,
    kInLine,
    kEscape,    ///< after ~ at the start of a line
    kFileName,  ///< after ~s
  };

  TypingResult press_data(const Keystroke& key);
  TypingResult press_escape(const Keystroke& key);
  TypingResult press_file_name(const Keystroke& key);

  TypingMode mode_ = TypingMode::kLineStart;
  std::string escape_;  ///< text after the ~
  bool is_explained_ = false;
};

}  // namespace xr3::term
