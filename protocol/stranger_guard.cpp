#include "protocol/stranger_guard.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace xr3 {
namespace {

using std::string_view_literals::operator""sv;

// The methods that a browser sends without asking first, and the others of RFC 9110 and RFC 5789.
constexpr std::array kGreetings = {"GET /"sv,     "HEAD /"sv,   "POST /"sv,  "PUT /"sv,
                                   "PATCH /"sv,   "DELETE /"sv, "TRACE /"sv, "OPTIONS /"sv,
                                   "CONNECT /"sv, "\x16\x03"sv};

}  // namespace

Verdict StrangerGuard::take(std::uint8_t byte) {
  if (verdict_ != Verdict::kHold) return verdict_;
  held_.push_back(static_cast<char>(byte));
  const auto begins = [this](std::string_view greeting) { return greeting.starts_with(held_); };
  const auto* greeting = std::find_if(kGreetings.begin(), kGreetings.end(), begins);
  if (greeting == kGreetings.end()) {
    held_.pop_back();
    verdict_ = Verdict::kPass;
  } else if (greeting->size() == held_.size()) {
    held_.pop_back();
    verdict_ = Verdict::kStranger;
  }
  return verdict_;
}

std::string StrangerGuard::release() { return std::exchange(held_, {}); }

}  // namespace xr3
