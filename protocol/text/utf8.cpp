#include "protocol/text/utf8.hpp"

namespace xr3 {
namespace {

bool is_between(std::string_view text, std::size_t at, unsigned low, unsigned high) {
  const auto byte = at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
  return low <= byte && byte <= high;
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  struct Form {
    unsigned first_low, first_high, second_low, second_high;
    std::size_t length;
  };
  constexpr Form kForms[] = {{0xC2, 0xDF, 0x80, 0xBF, 2}, {0xE0, 0xE0, 0xA0, 0xBF, 3},
                             {0xE1, 0xEC, 0x80, 0xBF, 3}, {0xED, 0xED, 0x80, 0x9F, 3},
                             {0xEE, 0xEF, 0x80, 0xBF, 3}, {0xF0, 0xF0, 0x90, 0xBF, 4},
                             {0xF1, 0xF3, 0x80, 0xBF, 4}, {0xF4, 0xF4, 0x80, 0x8F, 4}};
  for (const Form& form : kForms) {
    if (!is_between(text, 0, form.first_low, form.first_high)) continue;
    bool is_good = is_between(text, 1, form.second_low, form.second_high);
    for (std::size_t i = 2; i < form.length; ++i)
      is_good = is_good && is_between(text, i, 0x80, 0xBF);
    return is_good ? form.length : 0;
  }
  return 0;
}

}  // namespace xr3
