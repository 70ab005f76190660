// The client's end of a serial line: the reply that bytes from the controller are, given the
// inquiry. The inverse of line/rhino_reply.hpp. Independent of the machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/command.hpp"
#include "core/model.hpp"
#include "core/switches.hpp"
#include "protocol/explain/wire_record.hpp"

namespace xr3 {

/// The properties of the robot that the decoding of its replies needs.
struct ReplyContext {
  static constexpr int kLabels = 8;

  Profile profile = Profile::kPaper;
  /// The bit of the microswitch of each joint A...H, in the reply to J (A and B) or I; 0 if there
  /// is none. The default is the order of this project's robots and of the Mark III.
  std::array<std::uint8_t, kLabels> masks{16, 32, 1, 2, 4, 8, 16, 32};
  /// The camera's image; 0 x 0 without a camera, nullopt if unknown.
  std::optional<wire::PictureSize> camera = std::nullopt;
};

ReplyContext context_of(const Model& model);

/// The bits of input lines 5...8 in the reply to J.
InputMasks input_masks_of(const ReplyContext& context);

/// The number of bytes of the reply to a command: 0 if it has none, nullopt if the context does not
/// determine it.
std::optional<std::size_t> reply_size(const Command& command, const ReplyContext& context);

/// The reply with these bytes; nullopt if the controller does not reply to the command in this
/// form. Precondition: reply_size() is known, and `bytes` has that size, which is not 0.
std::optional<wire::Answered> decode_reply(const Command& command, std::string_view bytes,
                                           const ReplyContext& context);

}  // namespace xr3
