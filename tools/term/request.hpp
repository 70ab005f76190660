// The requests of a user of `xr3 term` by escapes at the start of a line (~. ~s ~b ~? ~~), as
// values.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace xr3::term {

/// Bytes for the robot.
struct SendBytes {
  std::string bytes;
  bool operator==(const SendBytes&) const = default;
};
struct SendFile {
  std::string path;
  bool operator==(const SendFile&) const = default;
};
struct SendBreak {
  bool operator==(const SendBreak&) const = default;
};
struct ShowHelp {
  bool operator==(const ShowHelp&) const = default;
};
/// A sentence for the user, without a line end.
struct ShowHint {
  std::string_view text;
  bool operator==(const ShowHint&) const = default;
};
struct Quit {
  bool operator==(const Quit&) const = default;
};

using UserRequest = std::variant<SendBytes, SendFile, SendBreak, ShowHelp, ShowHint, Quit>;

inline constexpr char kEscapeKey = '~';

/// The request of an escape, given the text after the ~: `.`, `s FILE`, `b`, `?` or `~`; nullopt if
/// the text is no escape.
std::optional<UserRequest> escape_of(std::string_view text);

/// The request of a line that was edited before it is sent: an escape, or the line and a CR.
UserRequest request_of_line(std::string_view line);

/// The keys as text, a line each.
std::string_view help_text();

}  // namespace xr3::term
