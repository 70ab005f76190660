// Names and other text from files and clients, made safe for a terminal, the log and reports. The
// bytes of a serial line are shown by readable() of protocol/explain/diagnostic.hpp instead.
//
// The flow through the folder: text from outside arrives as bytes. whole_number.hpp and
// numbers.hpp parse arguments and variables into numbers and say when they cannot.
// printable_line() and printable_lines() replace those that a terminal would execute or that
// change the direction of text, and printable_json() does so within JSON without changing its
// value. Every function that prints for people calls one of them last: server/print.hpp, the log,
// and the reports of tools/report. table.hpp formats numbers without superfluous digits and aligns
// columns; its cells are made printable first. text_stream.hpp is the stream for texts that are
// built in pieces: it throws if memory ends, where the standard stream would lose the rest.
// Nothing here depends on robots or on JSON values.
#pragma once

#include <string>
#include <string_view>

namespace xr3 {

/// The text as one line of UTF-8. Each byte becomes `\xNN` that is not UTF-8, or belongs to a
/// control character (C0, DEL, C1), to one that changes the direction of text or separates lines,
/// or to one that XML does not have (U+FFFE, U+FFFF).
std::string printable_line(std::string_view text);

/// The text as several lines: like printable_line(), but keeps line feeds and tabs.
std::string printable_lines(std::string_view text);

/// JSON with the same value and without unprintable characters: they become `\uNNNN`. Keeps line
/// feeds. Precondition: valid JSON.
std::string printable_json(std::string_view json);

}  // namespace xr3
