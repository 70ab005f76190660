#include "protocol/explain/reply_decoder.hpp"

#include <algorithm>
#include <cassert>

#include "protocol/line/rhino_reply.hpp"

namespace xr3 {
namespace {

using wire::PictureSize;
using DecodedReply = ReplyWith<PictureSize>;

constexpr int kSevenBitValues = 128;
constexpr int kMaxErrorMagnitude = 128;
constexpr unsigned kSwitchesOfI = 0x3f;
constexpr unsigned kInputsOfK = 0x0f;

std::size_t bytes_of_row(int pixels) {
  return static_cast<std::size_t>((pixels + kPixelsPerReplyByte - 1) / kPixelsPerReplyByte);
}

/// The bits of all switches that the inquiry asks for.
std::uint8_t fitted_bits(const ReplyContext& context, char inquiry) {
  unsigned bits = 0;
  for (int i = 0; i < ReplyContext::kLabels; ++i) {
    if (is_asked_for(static_cast<char>('A' + i), inquiry)) {
      bits |= context.masks.at(static_cast<std::size_t>(i));
    }
  }
  return static_cast<std::uint8_t>(bits);
}

/// The sizes of replies, without NoReply: 0.
struct SizeOf {
  const ReplyContext& context;

  std::optional<std::size_t> operator()(const CameraImage&) const {
    if (!context.camera) return std::nullopt;
    return bytes_of_row(context.camera->width) * static_cast<std::size_t>(context.camera->height);
  }
  std::optional<std::size_t> operator()(const CameraRow& row) const {
    if (!context.camera) return std::nullopt;
    return row.row < context.camera->height ? bytes_of_row(context.camera->width) : 0;
  }
  std::optional<std::size_t> operator()(const CameraPixel& pixel) const {
    if (!context.camera) return 1;
    return pixel.column < context.camera->width && pixel.row < context.camera->height ? 1 : 0;
  }
  template <class Each>
  std::optional<std::size_t> operator()(const Each&) const {
    return Inquiry<Each> ? 1 : 0;
  }
};

/// The replies with their bytes; NoReply if these bytes are none.
struct ReplyOf {
  std::string_view bytes;
  const ReplyContext& context;

  int byte() const { return static_cast<std::uint8_t>(bytes[0]); }
  bool is_inverted() const { return context.profile == Profile::kMark3; }

  /// The value of a printable reply of at most `max`, or nullopt.
  std::optional<unsigned> value(unsigned max) const {
    const int value = byte() - kReplyBase;
    const bool is_allowed = value >= 0 && value <= static_cast<int>(max);
    return is_allowed ? std::optional(static_cast<unsigned>(value)) : std::nullopt;
  }

  DecodedReply switches(char inquiry, unsigned switch_bits, unsigned input_bits) const {
    const auto sent = value(switch_bits | input_bits);
    if (!sent) return NoReply{};
    SwitchBits bits{0, fitted_bits(context, inquiry), 0, inquiry};
    const unsigned closed = is_inverted() ? ~*sent : *sent;
    bits.closed = static_cast<std::uint8_t>(closed & switch_bits & bits.fitted);
    bits.inputs = static_cast<std::uint8_t>(*sent & input_bits);
    return bits;
  }

  // mark3 clears the top bit of 128 and up. The byte 32 is then 0 or 128 to go, most often 0.
  DecodedReply decoded(const ErrorMagnitude*) const {
    const bool is_cut = is_inverted() && byte() < kReplyBase;
    const int counts = byte() - kReplyBase + (is_cut ? kSevenBitValues : 0);
    if (counts < 0 || counts > kMaxErrorMagnitude) return NoReply{};
    return ErrorMagnitude{counts};
  }
  DecodedReply decoded(const SignedError*) const {
    return SignedError{static_cast<std::int8_t>(bytes[0])};
  }
  DecodedReply decoded(const SwitchState*) const {
    if (byte() > 1) return NoReply{};
    return SwitchState{(byte() == 1) != is_inverted()};
  }
  DecodedReply decoded(const PixelValue*) const {
    const auto sent = value(1);
    if (!sent) return NoReply{};
    return PixelValue{*sent == 1};
  }
  DecodedReply operator()(const QuerySwitchesI&) const { return switches('I', kSwitchesOfI, 0); }
  DecodedReply operator()(const QuerySwitchesJ&) const {
    unsigned inputs = 0;
    for (const std::uint8_t mask : input_masks_of(context)) inputs |= mask;
    return switches('J', fitted_bits(context, 'J'), inputs);
  }
  DecodedReply operator()(const QueryInputs&) const { return switches('K', 0, kInputsOfK); }
  DecodedReply operator()(const CameraImage&) const { return picture(context.camera->height); }
  DecodedReply operator()(const CameraRow&) const { return picture(1); }
  DecodedReply picture(int rows) const {
    const bool is_printable = std::all_of(bytes.begin(), bytes.end(), [](char byte) {
      return byte >= kReplyBase && byte < kReplyBase + (1 << kPixelsPerReplyByte);
    });
    if (!is_printable) return NoReply{};
    return PictureSize{context.camera->width, rows};
  }
  /// The reply to any other command, whose type determines the meaning of the byte.
  template <class Each>
  DecodedReply operator()(const Each&) const {
    if constexpr (Inquiry<Each>)
      return decoded(static_cast<const typename Each::Answer*>(nullptr));
    else
      return NoReply{};
  }
};

}  // namespace

InputMasks input_masks_of(const ReplyContext& context) {
  return input_masks_of_j(context.masks[0], context.masks[1]);
}

ReplyContext context_of(const Model& model) {
  ReplyContext context;
  context.profile = model.profile();
  context.masks = {};
  for (int i = 0; i < model.motor_count(); ++i) {
    const Drive& drive = model.motor(i).drive;
    context.masks.at(static_cast<std::size_t>(drive.label - 'A')) =
        static_cast<std::uint8_t>(drive.microswitch.mask);
  }
  const auto& camera = model.workcell().camera;
  context.camera = camera ? PictureSize{camera->pixels_x, camera->pixels_y} : PictureSize{};
  return context;
}

std::optional<std::size_t> reply_size(const Command& command, const ReplyContext& context) {
  return std::visit(SizeOf{context}, command);
}

std::optional<wire::Answered> decode_reply(const Command& command, std::string_view bytes,
                                           const ReplyContext& context) {
  assert(!bytes.empty() && reply_size(command, context) == bytes.size());
  const DecodedReply reply = std::visit(ReplyOf{bytes, context}, command);
  if (std::holds_alternative<NoReply>(reply)) return std::nullopt;
  return wire::Answered{command, reply};
}

}  // namespace xr3
