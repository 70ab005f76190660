// The prompt of `xr3 watch` for the token. Keys in, the token out; it never shows the token.
#pragma once

#include <optional>
#include <string>

#include "tools/watch/command_mode.hpp"

namespace xr3::watch {

class TokenPrompt {
 public:
  void open() { is_open_ = true; }
  bool is_open() const { return is_open_; }

  /// Handles a key of the open prompt. Returns the token at Enter, unless nothing was typed.
  std::optional<std::string> press(const ModeKey& key);

  /// The question, with the length of the input so far; empty if the prompt is closed.
  std::string text() const;

 private:
  void close();

  bool is_open_ = false;
  std::string typed_;
};

}  // namespace xr3::watch
