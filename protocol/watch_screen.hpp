// The whole screen of `xr3 watch` as a function of what is known, of the connection and of its size.
// From the most important part to the least: title, joints, tool, events, blocks and lines, camera.
// It knows no terminal.
#pragma once

#include <string>

#include "protocol/text_screen.hpp"
#include "protocol/watch_known.hpp"

namespace xr3::watch {

/// How the connection stands.
struct Link {
  enum class Phase : std::uint8_t { kTrying, kLive };
  Phase phase = Phase::kTrying;
  std::string address;  ///< as the user gave it
  std::string trouble;  ///< why it does not stand, in words; empty: nothing is known yet
};

/// What is shown: the cell, the keys, or the cell for somebody who has no keys.
enum class Page : std::uint8_t { kCell, kHelp, kPrint };

/// A screen of this size, any size. What is known stays on it, dimmed by a word, when the server went.
TextScreen watch_screen(const Known& known, const Link& link, Page page, int rows, int columns);

}  // namespace xr3::watch
