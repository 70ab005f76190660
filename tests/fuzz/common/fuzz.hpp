// The functions that every fuzzer defines and uses. libFuzzer or the replay of the corpus
// calls run_within_limits() for each input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace xr3::fuzz {

/// The effort for one input. Most inputs are short and quick, so that many fit in an hour.
enum class Effort : std::uint8_t {
  kQuick,  ///< the properties that are cheap to check
  kFull,   ///< all properties, and inputs that expand to the limits of size
};

/// The effort that libFuzzer makes: full for one of 1024 inputs, depending only on the input.
Effort effort_for(std::string_view input);

/// libFuzzer makes no longer inputs. 0: none longer than the longest seed. Defined by each fuzzer.
extern const std::size_t kMaxInput;

/// Checks the fuzzer's properties on one input. Defined by each fuzzer.
void run(std::string_view input, Effort effort);

/// Calls run(), twice if it takes long, and requires that it allocates at most 64 MiB at any time
/// and takes at most 5 s of processor time.
void run_within_limits(std::string_view input, Effort effort);

/// Ends the process with a message unless the property holds.
void require(bool holds, const char* property);

}  // namespace xr3::fuzz
