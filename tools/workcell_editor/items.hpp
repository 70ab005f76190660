// The questions of the workcell dialogue, one function per kind of answer. A question has a prompt
// with a range and a default, a help text, and a function for the answer. Independent of the
// dialogue and of the terminal.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/workcell.hpp"

namespace xr3::dialogue {

struct Question {
  std::string prompt;
  std::string fallback;  ///< the answer for Enter alone, shown in brackets; may be empty
  std::string help;
  /// Handles an answer. Returns an empty string, or a sentence with the reason why it is invalid.
  std::function<std::string(const std::string&)> handle;
};

/// The prompt with the fallback and a trailing blank.
std::string shown(const Question& question);

struct Lengths {
  Micrometres min = 0;
  Micrometres max = 0;
};

/// The ranges that a workcell file allows for positions and for sizes.
inline constexpr Lengths kAnyPlace{-100'000'000, 100'000'000};
inline constexpr Lengths kAnySize{1, 100'000'000};

/// Returns the reason why a value cannot be used; empty if it can.
using NameCheck = std::function<std::string(const std::string&)>;

// Questions that store the answer in `value`, which must outlive the question. Its current value is
// the default.

/// Asks for a length. `sensible` is the range shown, `possible` the range accepted. The checks of
/// the complete block or camera report values between the two.
Question length_question(const std::string& prompt, Lengths sensible, Lengths possible,
                         Micrometres& value, const std::string& help);
Question yaw_question(const std::string& prompt, Microdegrees& value, const std::string& help);
Question whole_question(const std::string& prompt, int min, int max, int& value,
                        const std::string& help);
/// Asks for a text. `least` and `most`: length in bytes. `least` is 0 or 1; if it is 0, the answer
/// "-" is the empty text.
Question text_question(const std::string& prompt, std::size_t least, std::size_t most,
                       std::string& value, const std::string& help, const NameCheck& check);
Question yes_no_question(const std::string& prompt, bool& value, const std::string& help);
Question projection_question(const std::string& prompt, Projection& value, const std::string& help);

/// The words with the prefix `start`; only `start` itself if it is one of them.
std::vector<std::string> words_like(const std::string& start,
                                    const std::vector<std::string>& words);

/// The text without leading and trailing whitespace.
std::string_view trimmed(std::string_view text);

/// The length in millimetres, without superfluous digits.
std::string mm_text(Micrometres um);

}  // namespace xr3::dialogue
