#include "protocol/rhino_reply.hpp"

namespace xr3 {
namespace {

constexpr unsigned kAllOfI = 0x3f;
constexpr unsigned kSevenBits = 0x7f;
constexpr int kPixelsPerByte = 6;

char byte(unsigned value) { return static_cast<char>(static_cast<unsigned char>(value)); }
char printable(unsigned value) { return byte(value + kReplyBase); }

// Six pixels per byte, the leftmost in the highest bit; the last byte is padded with 0.
void append_row(const Image& image, int row, std::string& out) {
  for (int first = 0; first < image.width(); first += kPixelsPerByte) {
    unsigned bits = 0;
    for (int column = first; column < first + kPixelsPerByte; ++column) {
      bits = bits << 1U | (column < image.width() && image.at(column, row) ? 1U : 0U);
    }
    out.push_back(printable(bits));
  }
}

struct Encoder {
  Profile profile;
  std::string& out;

  void operator()(const NoReply&) const {}
  void operator()(const ErrorMagnitude& error) const {
    const auto value = static_cast<unsigned>(error.counts + kReplyBase);
    out.push_back(byte(profile == Profile::kMark3 ? value & kSevenBits : value));
  }
  void operator()(const SignedError& error) const {
    out.push_back(static_cast<char>(error.counts));
  }
  void operator()(const SwitchState& state) const {
    out.push_back(byte(state.closed == (profile == Profile::kPaper) ? 1 : 0));
  }
  void operator()(const SwitchBits& bits) const {
    out.push_back(printable(switch_code(bits, profile)));
  }
  void operator()(const CameraRows& rows) const {
    for (int row = 0; row < rows.image.height(); ++row) append_row(rows.image, row, out);
  }
  void operator()(const PixelValue& pixel) const { out.push_back(printable(pixel.set ? 1 : 0)); }
};

}  // namespace

std::uint8_t switch_code(const SwitchBits& bits, Profile profile) {
  unsigned switches = bits.closed;
  if (profile == Profile::kMark3) {
    const unsigned readable = bits.inquiry == 'I' ? kAllOfI : bits.fitted;
    switches = readable & ~static_cast<unsigned>(bits.closed);
  }
  return static_cast<std::uint8_t>(switches | bits.inputs);
}

void append_reply(const Reply& reply, Profile profile, std::string& out) {
  std::visit(Encoder{profile, out}, reply);
}

}  // namespace xr3
