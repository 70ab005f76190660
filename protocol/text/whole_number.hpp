// Whole numbers in arguments and in variables of the environment.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace xr3 {

/// The number in [low, high] that is the whole text; nullopt if it is none.
template <class Number>
std::optional<Number> whole_number(std::string_view text, Number low, Number high, int base = 10) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number, base);
  const bool is_good = error == std::errc() && rest == end && low <= number && number <= high;
  return is_good ? std::optional(number) : std::nullopt;
}

}  // namespace xr3
