#include "cell/failure.hpp"

#include <algorithm>

namespace xr3 {

FatalFailure::FatalFailure(std::string_view where, std::string_view what) noexcept {
  char* const last = text_.data() + kMaxBytes - 1;  // stays 0
  char* end = text_.data();
  for (const std::string_view part : {where, std::string_view(": "), what}) {
    const auto room = static_cast<std::size_t>(last - end);
    end = std::copy_n(part.data(), std::min(part.size(), room), end);
  }
}

void fail_fatally(const char* where, const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::exception& error) {
    throw FatalFailure(where, error.what());
  } catch (...) {
    throw FatalFailure(where, "an exception of unknown type");
  }
}

}  // namespace xr3
