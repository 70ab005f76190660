// The server's answers to the messages of a monitor client, predicted by a simple reading of them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace xr3::fuzz {

/// Whether a message of the server is a `result` or a `pong`.
bool is_answer(std::string_view message);

/// The number of `result` and `pong` that these messages get. A `get` of a frame gets the frame.
std::size_t answers_to(const std::vector<std::string>& messages);

}  // namespace xr3::fuzz
