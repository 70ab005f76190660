// What every fuzzer defines and uses. run_within_limits() is called for each input, by libFuzzer or
// by the replay of the corpus.
#pragma once

#include <string_view>

namespace xr3::fuzz {

/// Checks the fuzzer's properties on one input. Defined by each fuzzer.
void run(std::string_view input);

/// Calls run(), and requires that it allocates at most 64 MiB at any time.
void run_within_limits(std::string_view input);

/// Ends the process with a message unless the property holds.
void require(bool holds, const char* property);

}  // namespace xr3::fuzz
