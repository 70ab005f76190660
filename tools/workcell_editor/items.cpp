#include "tools/workcell_editor/items.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "protocol/files/paper_form/lines.hpp"
#include "protocol/json/source.hpp"
#include "protocol/text/printable.hpp"
#include "protocol/text/table.hpp"

namespace xr3::dialogue {
namespace {

constexpr int kTurnDeg = 360;
constexpr Microdegrees kHalfTurn = 180'000'000;
constexpr int kDecimals = 6;

std::string range_text(const std::string& min, const std::string& max, const std::string& unit) {
  return min + " to " + max + (unit.empty() ? "" : " " + unit);
}

/// Accepts a number within the range and passes it to `set`.
Question number_question(const std::string& prompt, double min, double max, const std::string& unit,
                         const std::function<void(double)>& set) {
  const std::string range = range_text(plain_number(min), plain_number(max), unit);
  Question question;
  question.prompt = prompt + " (" + range + ")";
  question.handle = [=](const std::string& answer) -> std::string {
    const Json number = paper::number_or_text(answer);
    if (!number.is_number()) return "Not a number: " + range + ".";
    const auto value = number.get<double>();
    if (value < min || value > max) return "That is out of range: " + range + ".";
    set(value);
    return "";
  };
  return question;
}

/// Passes the index of the answer in `words` to `set`; an unambiguous prefix suffices.
Question word_question(const std::string& prompt, const std::vector<std::string>& words,
                       std::size_t fallback, const std::function<void(std::size_t)>& set,
                       const std::string& help) {
  const std::string list = words[0] + " or " + words[1];
  Question question;
  question.prompt = prompt + " (" + list + ")";
  question.fallback = words[fallback];
  question.help = help;
  question.handle = [=](const std::string& answer) -> std::string {
    const std::vector<std::string> like = words_like(answer, words);
    if (like.size() != 1) return "Please answer " + list + ".";
    set(like[0] == words[0] ? 0 : 1);
    return "";
  };
  return question;
}

}  // namespace

std::string shown(const Question& question) {
  if (question.prompt.ends_with('>')) return question.prompt + " ";
  const std::string fallback = question.fallback.empty() ? "" : " [" + question.fallback + "]";
  return question.prompt + fallback + ": ";
}

std::string mm_text(Micrometres um) { return plain_number(mm(um)); }

Question length_question(const std::string& prompt, Lengths sensible, Lengths possible,
                         Micrometres& value, const std::string& help) {
  Question question = number_question(prompt, mm(possible.min), mm(possible.max), "mm",
                                      [&value](double length) { value = micrometres(length); });
  question.prompt =
      prompt + " (" + range_text(mm_text(sensible.min), mm_text(sensible.max), "mm") + ")";
  question.fallback = mm_text(std::clamp(value, possible.min, possible.max));
  question.help = help;
  return question;
}

Question yaw_question(const std::string& prompt, Microdegrees& value, const std::string& help) {
  Question question =
      number_question(prompt, -kTurnDeg, kTurnDeg, "degrees", [&value](double angle) {
        value = microdegrees(angle);
        if (value > kHalfTurn) value -= 2 * kHalfTurn;
        if (value <= -kHalfTurn) value += 2 * kHalfTurn;
      });
  question.fallback = plain_number(degrees(value), kDecimals);
  question.help = help;
  return question;
}

Question whole_question(const std::string& prompt, int min, int max, int& value,
                        const std::string& help) {
  Question question = number_question(prompt, min, max, "", [](double) {});
  question.handle = [in_range = question.handle, &value](const std::string& answer) -> std::string {
    std::string problem = in_range(answer);
    if (!problem.empty()) return problem;
    const auto number = paper::number_or_text(answer).get<double>();
    if (number != std::floor(number)) return "Not a whole number.";
    value = static_cast<int>(number);
    return "";
  };
  question.fallback = std::to_string(value);
  question.help = help;
  return question;
}

Question text_question(const std::string& prompt, std::size_t least, std::size_t most,
                       std::string& value, const std::string& help, const NameCheck& check) {
  Question question;
  question.prompt = prompt;
  question.fallback = value;
  question.help = help;
  question.handle = [=, &value](const std::string& answer) -> std::string {
    const std::string text = least == 0 && answer == "-" ? "" : answer;
    if (text.size() < least) return "It must not be empty.";
    if (text.size() > most) return "That is too long: at most " + std::to_string(most) + " bytes.";
    if (text != printable_line(text)) return "That contains unprintable characters.";
    std::string problem = check ? check(text) : "";
    if (problem.empty()) value = text;
    return problem;
  };
  return question;
}

std::vector<std::string> words_like(const std::string& start,
                                    const std::vector<std::string>& words) {
  std::vector<std::string> like;
  for (const std::string& word : words) {
    if (word == start) return {word};
    if (!start.empty() && word.starts_with(start)) like.push_back(word);
  }
  return like;
}

Question projection_question(const std::string& prompt, Projection& value,
                             const std::string& help) {
  const auto set = [&value](std::size_t word) { value = static_cast<Projection>(word); };
  return word_question(prompt, {"orthographic", "perspective"}, static_cast<std::size_t>(value),
                       set, help);
}

Question yes_no_question(const std::string& prompt, bool& value, const std::string& help) {
  const auto set = [&value](std::size_t word) { value = word == 0; };
  return word_question(prompt, {"yes", "no"}, value ? 0 : 1, set, help);
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

}  // namespace xr3::dialogue
