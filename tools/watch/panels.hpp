// The panels of the `xr3 watch` screen. Each is painted into a given area; content that does not
// fit is left out, the least important parts first. Independent of each other and of the terminal.
#pragma once

#include <string>
#include <vector>

#include "tools/text/screen.hpp"
#include "tools/watch/watched_cell.hpp"

namespace xr3::watch {

/// Minimum length of a useful bar.
inline constexpr int kMinBarLength = 10;

/// Paints a heading, the joints, then the tool as the last row. The heading is left out if room is
/// short.
void paint_joints(TextScreen& screen, const TextArea& area, const Known& known,
                  const WatchedState& state);

/// Paints one row: opening, tip and the held block.
void paint_tool(TextScreen& screen, const TextArea& area, const WatchedState& state);

/// Paints a rule, the blocks, and the digital lines in the last row.
void paint_blocks_and_lines(TextScreen& screen, const TextArea& area, const WatchedState& state);

/// Paints a rule, then the latest notes, the newest at the bottom.
void paint_notes(TextScreen& screen, const TextArea& area, const Known& known);

/// Paints a heading and a row for each line. Columns that do not fit are left out, as are rows: the
/// last one then shows their number.
void paint_serial_lines(TextScreen& screen, const TextArea& area, const Known& known,
                        const std::vector<LineEntry>& lines);

/// A duration, such as "3 min 20 s".
std::string age_text(std::int64_t seconds);

/// Paints a rule, then the image in half blocks, two pixels per cell, shrunk to fit.
void paint_image(TextScreen& screen, const TextArea& area, const WatchedImage& image);

/// Paints a line across the area's first row that contains a name.
void paint_rule(TextScreen& screen, const TextArea& area, const std::string& name);

/// A tick in simulated seconds, such as "12.345 s".
std::string seconds_text(std::int64_t tick, std::int64_t tick_hz);

/// The largest size with the image's proportions that exceeds neither the image nor these limits.
ImageSize shrunk_size(const WatchedImage& image, std::size_t most_columns, std::size_t most_rows);

/// The image shrunk to shrunk_size(). A pixel is set if a third of the pixels that it replaces are.
WatchedImage shrunk(const WatchedImage& image, std::size_t most_columns, std::size_t most_rows);

}  // namespace xr3::watch
