// The parts of the screen of `xr3 watch`, each painted into an area that is given: what does not fit
// is left out, the least important first. They know neither each other nor a terminal.
#pragma once

#include <string>

#include "protocol/text_screen.hpp"
#include "protocol/watch_known.hpp"

namespace xr3::watch {

/// Columns that a bar needs to say something.
inline constexpr int kLeastBar = 10;

/// A heading, the joints of the state, then the tool as one more row; the heading goes first where room is short.
void paint_joints(TextScreen& screen, const TextArea& area, const Known& known, const State& state);

/// One row: opening, tip and what is held.
void paint_tool(TextScreen& screen, const TextArea& area, const State& state);

/// A rule, the blocks, and the digital lines in the last row.
void paint_blocks_and_lines(TextScreen& screen, const TextArea& area, const State& state);

/// A rule, then the last notes, the newest at the bottom.
void paint_notes(TextScreen& screen, const TextArea& area, const Known& known);

/// A rule, then the image in half blocks, two pixels a cell, made smaller until it fits.
void paint_image(TextScreen& screen, const TextArea& area, const Image& image);

/// A line across the area's first row with a name in it.
void paint_rule(TextScreen& screen, const TextArea& area, const std::string& name);

/// A tick as simulated seconds, such as 12.345 s.
std::string seconds_text(std::int64_t tick, std::int64_t tick_hz);

/// The greatest size with the image's proportions, no larger than it was nor than this.
ImageSize shrunk_size(const Image& image, std::size_t most_columns, std::size_t most_rows);

/// `image` no larger than this, its proportions kept: a pixel is set where a third of what lies
/// under it is.
Image shrunk(const Image& image, std::size_t most_columns, std::size_t most_rows);

}  // namespace xr3::watch
