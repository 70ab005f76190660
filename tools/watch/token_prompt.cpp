#include "tools/watch/token_prompt.hpp"

#include <string_view>
#include <utility>

namespace xr3::watch {
namespace {

constexpr char kLeave = '\x1B';
constexpr char kClear = '\x15';  // Ctrl-U
constexpr std::string_view kEnter = "\r\n";
constexpr std::string_view kErase = "\b\x7F";
constexpr std::size_t kMaxToken = 1024;

}  // namespace

std::optional<std::string> TokenPrompt::press(const ModeKey& key) {
  if (key.letter == 0 || key.is_alt) return {};
  if (key.letter == kLeave) {
    close();
  } else if (key.letter == kClear) {
    typed_.clear();
  } else if (kErase.find(key.letter) != std::string_view::npos) {
    if (!typed_.empty()) typed_.pop_back();
  } else if (kEnter.find(key.letter) != std::string_view::npos) {
    std::string token = std::exchange(typed_, {});
    close();
    if (!token.empty()) return token;
  } else if (typed_.size() < kMaxToken) {
    typed_ += key.letter;
  }
  return {};
}

std::string TokenPrompt::text() const {
  if (!is_open_) return "";
  return "token, not shown: " + std::to_string(typed_.size()) +
         " characters_   Enter sends it, Esc leaves it";
}

void TokenPrompt::close() {
  is_open_ = false;
  typed_.clear();
}

}  // namespace xr3::watch
