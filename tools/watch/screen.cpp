#include "tools/watch/screen.hpp"

#include <algorithm>
#include <array>

#include "protocol/text/table.hpp"
#include "tools/watch/command_mode.hpp"
#include "tools/watch/panels.hpp"

namespace xr3::watch {
namespace {

constexpr int kMinNotes = 4;   ///< rows, including its rule
constexpr int kMinMiddle = 3;  ///< rows for blocks and lines: a rule, one block, the lines
constexpr int kMinImageColumns = 24;
constexpr int kMinImage = 4;       ///< rows, including its rule
constexpr int kWideColumns = 130;  ///< minimum width for the camera beside all tables
constexpr int kWideRows = 16;
constexpr int kWideLeft = 84;    ///< minimum width of the tables in that layout
constexpr int kTickWidth = 78;   ///< minimum width for epoch and tick in the title
constexpr int kLinesWidth = 47;  ///< width of blocks and lines beside a camera

constexpr std::array kHelp{
    "q  Esc  Ctrl-C   leave",
    "space            pause or resume the clock",
    ".                step ten ticks, while paused",
    ">                step one second, while paused",
    "h                home, like A$ on a line: also clears a stall",
    "m  Alt -         the menu of the controller's functions: display, view, status",
    "                 line, simulator; each has a letter and most have Alt F1 to F6",
    "l                the serial lines: who is connected, with bytes and settings",
    "t                type the token of the server, if it needs one",
    "?                show or leave this page",
    "",
    "A bar shows the position of a joint between its limits.",
    "error: counts to go; speed: counts per second; switch: its microswitch.",
    "Digital lines show their number while they are high.",
    "Events omit moves and switches, which the table shows.",
};

/// Puts one text at the start of a row and another at its end if both fit.
void paint_ends(TextScreen& screen, int row, const std::string& left, const std::string& right,
                TextStyle style) {
  for (int i = 0; i < screen.columns(); ++i) screen.put_letter(row, i, U' ', style);
  const int after = screen.put(row, 1, left, style, screen.columns() - 2);
  const int width = static_cast<int>(one_column_letters(right).size());
  const int at = screen.columns() - 1 - width;
  if (at > after + 1) screen.put(row, at, right, style, width);
}

std::string mode_text(const Known& known) {
  switch (known.mode) {
    case WatchedClockMode::kReal: return "real x " + plain_number(known.rate, 6);
    case WatchedClockMode::kManual: return "paused";
    case WatchedClockMode::kBytes: return "bytes";
  }
  return "";
}

/// The text of the clock, with epoch and tick if they fit beside `left`.
std::string clock_text(const Known& known, int columns, const std::string& left) {
  const std::string mode = mode_text(known);
  const std::string time = "   " + seconds_text(known.tick, known.tick_hz);
  const std::string whole = mode + "   epoch " + std::to_string(known.epoch) + "   tick " +
                            std::to_string(known.tick) + time;
  const int width = static_cast<int>(one_column_letters(left).size() + whole.size());
  return columns < kTickWidth || width + 3 >= columns ? mode + time : whole;
}

void paint_title(TextScreen& screen, const Known& known, const Link& link) {
  std::string left = "xr3 watch";
  if (!known.cell.empty()) left += "   " + known.robot + "   " + known.cell;
  const bool is_known = known.state.has_value();
  paint_ends(screen, 0, left, is_known ? clock_text(known, screen.columns(), left) : link.address,
             TextStyle::kTitle);
}

std::string keys_text(const Known& known) {
  const bool is_standing = known.mode == WatchedClockMode::kManual;
  std::string keys = "q quit   ? help   m menu   l lines";
  if (known.has_control) {
    keys += is_standing ? "   space resume   . step   h home" : "   space pause   h home";
  } else if (!known.server.empty()) {
    keys += known.is_locked ? "   t token" : "   t token   read only";
  }
  return keys;
}

/// Paints the prompt; without one the keys, or instead of them the server's last message.
void paint_footer(TextScreen& screen, const Known& known, Page page, const std::string& prompt) {
  if (!prompt.empty()) return paint_ends(screen, screen.rows() - 1, prompt, "", TextStyle::kTitle);
  const bool is_printed = page == Page::kPrint || page == Page::kPrintLines;
  const std::string keys = is_printed ? "" : keys_text(known);
  const bool has_message = !known.last_message.empty();
  paint_ends(screen, screen.rows() - 1, has_message ? known.last_message : keys,
             has_message ? "" : known.server, TextStyle::kTitle);
}

std::string stall_text(const std::string& stall) {
  if (stall == "protected_region") return "the tool would enter the protected region";
  if (stall == "work_surface") return "the tool would enter the work surface";
  return stall;
}

/// The destination of commands while the simulator is disabled.
std::string disabled_text(const std::optional<Device>& device) {
  if (!device || !device->is_engaged) return "disabled: only A@ is executed";
  if (device->is_there) return "disabled: commands go to device " + device->path;
  return "disabled: device " + device->path + " is not there; commands are dropped";
}

/// The most important notice; empty if there is none.
std::string banner_text(const WatchedState& state, const Link& link) {
  if (link.phase != Link::Phase::kLive) {
    return (link.trouble.empty() ? "no connection" : link.trouble) +
           "; retrying, the last known state is below";
  }
  if (!state.stalled.empty()) {
    return "STALLED: " + stall_text(state.stalled) + "; h (or A$, or reset) clears it";
  }
  return state.is_enabled ? "" : disabled_text(state.device);
}

void paint_lines(TextScreen& screen, const std::vector<std::string>& lines) {
  int row = std::max(1, (screen.rows() - static_cast<int>(lines.size())) / 2);
  std::size_t longest = 0;
  for (const std::string& line : lines) longest = std::max(longest, line.size());
  const int column = std::max(1, (screen.columns() - static_cast<int>(longest)) / 2);
  for (const std::string& line : lines) {
    screen.put(row++, column, line, TextStyle::kPlain, screen.columns() - column - 1);
  }
}

void paint_waiting(TextScreen& screen, const Known& known, const Link& link) {
  if (link.phase == Link::Phase::kLive && known.is_locked)
    return paint_lines(screen, {"This server shows nothing without its token.", "",
                                "Press t and type it, or start xr3 watch with --token-file FILE,",
                                "or with the token in XR3_TOKEN."});
  if (link.phase == Link::Phase::kLive)
    return paint_lines(screen, {"waiting for the robot's state"});
  if (link.trouble.empty()) return paint_lines(screen, {"connecting to " + link.address});
  paint_lines(screen,
              {link.trouble + ".", "", "Start one with: xr3 serve", "Retrying every second."});
}

/// The rows of the parts between title and footer, from top to bottom.
struct Heights {
  int joints = 0;
  int tool = 0;
  int middle = 0;  ///< blocks and lines, and the camera unless it is beside all tables
  int notes = 0;
};

/// Rows that the image can use in `columns` columns, including its rule.
int useful_image_rows(const WatchedImage& image, int columns) {
  const auto room = static_cast<std::size_t>(std::max(columns, 1));
  return static_cast<int>(shrunk_size(image, room, image.height).height + 1) / 2 + 1;
}

/// The heights of the parts. `image_rows`: the rows of the middle that the image can use.
Heights heights_for(const WatchedState& state, int rows, int image_rows) {
  Heights heights;
  const int table = static_cast<int>(state.joints.size()) + 2;
  heights.joints = std::min(rows, table);
  heights.tool = std::min(1, rows - heights.joints);
  const int rest = rows - heights.joints - heights.tool;
  heights.notes = std::min(rest, std::max(kMinNotes, rest / 3 + 1));
  heights.middle = rest - heights.notes;
  if (heights.middle < kMinMiddle) heights.middle = 0;
  const int useful = static_cast<int>(std::min<std::size_t>(state.blocks.size(), 1000)) + 2;
  heights.middle = std::min(heights.middle, std::max(useful, image_rows));
  heights.notes = rest - heights.middle;
  return heights;
}

void paint_middle(TextScreen& screen, TextArea area, const Known& known,
                  const WatchedState& state) {
  const bool has_room = area.columns > kLinesWidth + kMinBarLength && area.rows >= kMinImage;
  if (known.image && has_room) {
    const int width = std::min(area.columns - kLinesWidth - 1, 2 * (area.rows - 1) + 12);
    TextArea right = area;
    right.columns = width;
    right.column = area.column + area.columns - width;
    area.columns -= width + 1;
    paint_image(screen, right, *known.image);
  }
  paint_blocks_and_lines(screen, area, state);
}

/// Paints joints and tool. Returns the area below them, of the middle.
TextArea paint_upper(TextScreen& screen, TextArea area, const Known& known,
                     const WatchedState& state, const Heights& heights) {
  paint_joints(screen, {area.row, area.column, heights.joints, area.columns}, known, state);
  area.row += heights.joints;
  if (heights.tool > 0) {
    paint_tool(screen, {area.row, area.column, 1, area.columns}, state);
  }
  area.row += heights.tool;
  area.rows = heights.middle;
  return area;
}

/// Paints the wide layout, without title, banner and footer: the camera beside all tables.
void paint_wide(TextScreen& screen, TextArea area, const Known& known, const WatchedState& state,
                const WatchedImage& image) {
  const int most_columns = area.columns - kWideLeft - 2;
  const int image_rows = useful_image_rows(image, most_columns);
  const int table = static_cast<int>(state.joints.size()) + 3;
  const Heights heights = heights_for(state, area.rows, image_rows - table);
  const int upper = area.rows - heights.notes;
  const int width = std::min(most_columns, std::max(kMinImageColumns, 4 * upper));
  paint_image(screen, {area.row, area.column + area.columns - width, upper, width}, image);
  paint_notes(screen, {area.row + upper, area.column, heights.notes, area.columns}, known);
  area.columns -= width + 2;
  paint_blocks_and_lines(screen, paint_upper(screen, area, known, state, heights), state);
}

void paint_narrow(TextScreen& screen, const TextArea& area, const Known& known,
                  const WatchedState& state) {
  const int columns = area.columns - kLinesWidth - 1;
  const int image_rows = known.image ? useful_image_rows(*known.image, columns) : 0;
  const Heights heights = heights_for(state, area.rows, image_rows);
  paint_middle(screen, paint_upper(screen, area, known, state, heights), known, state);
  const int row = area.row + area.rows - heights.notes;
  if (heights.notes > 0) {
    paint_notes(screen, {row, area.column, heights.notes, area.columns}, known);
  }
}

/// Paints the banner, if there is one. Returns the area between it and the footer.
TextArea paint_banner(TextScreen& screen, const WatchedState& state, const Link& link) {
  TextArea area{1, 1, std::max(0, screen.rows() - 2), std::max(0, screen.columns() - 2)};
  const std::string banner = banner_text(state, link);
  if (banner.empty() || area.rows == 0) return area;
  screen.put(area.row++, area.column, banner, TextStyle::kBad, area.columns);
  --area.rows;
  return area;
}

void paint_state(TextScreen& screen, const Known& known, const WatchedState& state,
                 const Link& link) {
  TextArea area = paint_banner(screen, state, link);
  if (known.display && !known.display->status_text.empty() && area.rows > 0) {
    --area.rows;
    screen.put(area.row + area.rows, area.column, known.display->status_text, TextStyle::kStrong,
               area.columns);
  }
  const bool has_room = area.columns >= kWideColumns && area.rows >= kWideRows;
  if (known.image && has_room) {
    paint_wide(screen, area, known, state, *known.image);
  } else {
    paint_narrow(screen, area, known, state);
  }
}

void paint_lines_page(TextScreen& screen, const Known& known, const WatchedState& state,
                      const Link& link) {
  const TextArea area = paint_banner(screen, state, link);
  if (!known.has_control)
    return paint_lines(screen, {"The list of serial lines needs the server's token.", "",
                                "Press t and type it, or start xr3 watch with --token-file FILE,",
                                "or with the token in XR3_TOKEN."});
  if (!known.lines) return paint_lines(screen, {"waiting for the list of serial lines"});
  if (known.lines->empty())
    return paint_lines(
        screen, {"No serial line is open.", "",
                 "Connect a robot program to the robot port (usually 9600), or run xr3 term."});
  paint_serial_lines(screen, area, known, *known.lines);
}

}  // namespace

TextScreen watch_screen(const Known& known, const Link& link, Page page, int rows, int columns,
                        const std::string& prompt) {
  TextScreen screen(rows, columns);
  if (page == Page::kHelp) {
    paint_lines(screen, {kHelp.begin(), kHelp.end()});
  } else if (page == Page::kMenu) {
    paint_lines(screen, menu_lines(known.display, !known.state || known.state->is_enabled));
  } else if (!known.state) {
    paint_waiting(screen, known, link);
  } else if (page == Page::kLines || page == Page::kPrintLines) {
    paint_lines_page(screen, known, *known.state, link);
  } else {
    paint_state(screen, known, *known.state, link);
  }
  paint_title(screen, known, link);
  paint_footer(screen, known, page, prompt);
  return screen;
}

}  // namespace xr3::watch
