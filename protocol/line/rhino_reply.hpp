// Encodes replies as bytes in either profile (paper, Tables VI and VII; the hardware for mark3).
#pragma once

#include <cstdint>
#include <string>

#include "core/command.hpp"
#include "core/model.hpp"

namespace xr3 {

/// The offset added to the value of a printable reply.
inline constexpr int kReplyBase = 32;
/// The pixels of a camera row in each byte of its reply, the leftmost in the highest bit.
inline constexpr int kPixelsPerReplyByte = 6;

/// The value of the reply to I, J or K, without kReplyBase. A closed switch is 1 in the paper's
/// profile and 0 in mark3's, where bits of I without a switch are 1. Input lines are never
/// inverted.
std::uint8_t switch_code(const SwitchBits& bits, Profile profile);

/// Appends the bytes of a reply; none for NoReply.
void append_reply(const Reply& reply, Profile profile, std::string& out);

}  // namespace xr3
