// Replies as bytes, in either profile (paper, Tables VI and VII; hardware for mark3).
#pragma once

#include <cstdint>
#include <string>

#include "core/command.hpp"
#include "core/model.hpp"

namespace xr3 {

/// What a printable reply adds to its value.
inline constexpr int kReplyBase = 32;

/// The value that I, J or K answers, less 32: closed switches are 1 in the paper's profile and 0 in
/// mark3's, where bits of I without a switch read 1; input lines are never inverted.
std::uint8_t switch_code(const SwitchBits& bits, Profile profile);

/// Appends the bytes of a reply; nothing for NoReply.
void append_reply(const Reply& reply, Profile profile, std::string& out);

}  // namespace xr3
