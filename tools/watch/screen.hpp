// The complete screen of `xr3 watch` as a function of the data, the connection and the screen's
// size. The parts in order of importance: title, joints, tool, events, blocks and lines, camera.
// Independent of the terminal.
#pragma once

#include <string>

#include "tools/text/screen.hpp"
#include "tools/watch/watched_cell.hpp"

namespace xr3::watch {

/// The state of the connection.
struct Link {
  enum class Phase : std::uint8_t { kTrying, kLive };
  Phase phase = Phase::kTrying;
  std::string address;  ///< as the user gave it
  std::string trouble;  ///< reason why there is no connection; empty if not known yet
};

/// The page on the screen: the cell, the help page, the menu of command mode, or the serial lines;
/// or the cell or the lines without a line of keys, for printing.
enum class Page : std::uint8_t { kCell, kHelp, kMenu, kLines, kPrint, kPrintLines };

/// The screen; any size is allowed. A `prompt` replaces the line of keys. After the connection is
/// lost the last data stay on the screen, with a notice.
TextScreen watch_screen(const Known& known, const Link& link, Page page, int rows, int columns,
                        const std::string& prompt = "");

}  // namespace xr3::watch
