// The questions of the workcell's dialogue, one kind of answer each: a prompt with a range and a
// default, a word of help, and what to do with the answer. They know no dialogue and no terminal.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/workcell.hpp"

namespace xr3::dialogue {

struct Question {
  std::string prompt;
  std::string fallback;  ///< what Enter alone stands for, shown in brackets; may be empty
  std::string help;
  /// Takes an answer and returns nothing, or says in a sentence what is wrong with it.
  std::function<std::string(const std::string&)> take;
};

/// The prompt as it is shown: with the fallback, and a blank at its end.
std::string shown(const Question& question);

struct Lengths {
  Micrometres min = 0;
  Micrometres max = 0;
};

/// What a workcell file can hold: any position, and any size.
inline constexpr Lengths kAnyPlace{-100'000'000, 100'000'000};
inline constexpr Lengths kAnySize{1, 100'000'000};

/// Says why a value cannot be used; nothing if it can.
using NameCheck = std::function<std::string(const std::string&)>;

// All write the answer to `value`, which must outlive the question and is the fallback.

/// `sensible` is the range that is shown, `possible` the one that is taken: what lies between them is
/// for the checks of the whole block or camera to tell of.
Question length_question(const std::string& prompt, Lengths sensible, Lengths possible,
                         Micrometres& value, const std::string& help);
Question yaw_question(const std::string& prompt, Microdegrees& value, const std::string& help);
Question whole_question(const std::string& prompt, int min, int max, int& value,
                        const std::string& help);
/// `least` is 0 or 1; of a text that may be empty a lone - makes it so.
Question text_question(const std::string& prompt, std::size_t least, std::size_t most,
                       std::string& value, const std::string& help, const NameCheck& check);
Question yes_no_question(const std::string& prompt, bool& value, const std::string& help);
/// One of a few words, or the beginning of one; `value` is its index.
Question choice_question(const std::string& prompt, const std::vector<std::string>& words,
                         std::size_t& value, const std::string& help);

/// The words that begin with `start`, or the one that is `start`.
std::vector<std::string> words_like(const std::string& start,
                                    const std::vector<std::string>& words);

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// Millimetres without needless digits.
std::string words(Micrometres um);

}  // namespace xr3::dialogue
