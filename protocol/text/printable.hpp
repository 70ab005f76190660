// Names and other text from files and clients, made safe for a terminal, the log and reports. The
// bytes of a serial line are shown by readable() of protocol/explain/diagnostic.hpp instead.
#pragma once

#include <string>
#include <string_view>

namespace xr3 {

/// The text as one line of UTF-8. Each byte becomes `\xNN` that is not UTF-8, or belongs to a
/// character that a terminal obeys (C0, DEL, C1), that changes the direction of text or separates
/// lines, or that XML does not have (U+FFFE, U+FFFF).
std::string printable_line(std::string_view text);

/// The same for several lines: keeps line feeds and tabs.
std::string printable_lines(std::string_view text);

/// JSON with the same value and without these characters: they become `\uNNNN`. Keeps line feeds.
/// Precondition: valid JSON.
std::string printable_json(std::string_view json);

}  // namespace xr3
