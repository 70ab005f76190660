#include "protocol/line/line_word.hpp"

#include <algorithm>

#include "protocol/line/byte_classes.hpp"

namespace xr3 {
namespace {

struct WordMeaning {
  std::string_view word;
  Subject subject;
};

/// docs/protocol.md has the same table, with reasons.
constexpr std::array<WordMeaning, 12> kWords = {{{"HELP", Subject::kHelp},
                                                 {"HELLO", Subject::kHelp},
                                                 {"QUIT", Subject::kLeaving},
                                                 {"EXIT", Subject::kLeaving},
                                                 {"BYE", Subject::kLeaving},
                                                 {"LOGOUT", Subject::kLeaving},
                                                 {"STOP", Subject::kStopping},
                                                 {"HALT", Subject::kStopping},
                                                 {"HOME", Subject::kHoming},
                                                 {"RESET", Subject::kResetting},
                                                 {"OPEN", Subject::kJaws},
                                                 {"CLOSE", Subject::kJaws}}};

/// The first word that begins with these letters; nullptr if none does.
const WordMeaning* word_beginning(std::string_view letters) {
  const auto* const found =
      std::find_if(kWords.begin(), kWords.end(), [letters](const WordMeaning& each) {
        return std::equal(letters.begin(), letters.end(), each.word.begin(),
                          each.word.begin() + std::min(letters.size(), each.word.size()),
                          [](char typed, char wanted) {
                            return letter_of(static_cast<std::uint8_t>(typed)) ==
                                   static_cast<std::uint8_t>(wanted);
                          });
      });
  return found == kWords.end() ? nullptr : found;
}

}  // namespace

std::optional<Parsed> LineWord::feed(std::uint8_t byte, std::uint64_t offset) {
  if (is_line_end(byte)) {
    const std::optional<Parsed> word = end(byte, offset);
    *this = {};
    return word;
  }
  const bool leads = size_ == 0 && is_space(byte);
  if (leads || size_ == kNoWord) return std::nullopt;
  if (size_ == 0) from_ = offset;
  letters_.at(size_++) = static_cast<char>(byte);
  if (word_beginning(letters()) != nullptr) return std::nullopt;
  *this = {};
  size_ = kNoWord;
  return std::nullopt;
}

std::optional<Parsed> LineWord::end(std::uint8_t byte, std::uint64_t offset) const {
  if (size_ == 0 || size_ == kNoWord) return std::nullopt;
  const WordMeaning* const word = word_beginning(letters());
  if (word->word.size() != size_) return std::nullopt;
  Parsed line{from_, offset + 1, {}, Problem{ProblemCode::kWord, word->subject}};
  for (const char letter : letters()) line.raw.push(static_cast<std::uint8_t>(letter));
  line.raw.push(byte);
  return line;
}

}  // namespace xr3
