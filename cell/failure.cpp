#include "cell/failure.hpp"

#include <algorithm>

namespace xr3 {

VitalFailure::VitalFailure(std::string_view where, std::string_view what) noexcept {
  char* const last = text_.data() + kMaxBytes - 1;  // stays 0
  char* end = text_.data();
  for (const std::string_view part : {where, std::string_view(": "), what}) {
    const auto room = static_cast<std::size_t>(last - end);
    end = std::copy_n(part.data(), std::min(part.size(), room), end);
  }
}

void fail_vitally(const char* where, const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::exception& error) {
    throw VitalFailure(where, error.what());
  } catch (...) {
    throw VitalFailure(where, "an exception of unknown type");
  }
}

}  // namespace xr3
