#include "protocol/line/rhino_reply.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace xr3 {
namespace {

constexpr unsigned kAllOfI = 0x3f;
constexpr unsigned kSevenBits = 0x7f;

char byte(unsigned value) { return static_cast<char>(static_cast<unsigned char>(value)); }
char printable(unsigned value) { return byte(value + kReplyBase); }

/// The byte for six pixels, whose leftmost is the lowest bit: in the reply it is the highest.
constexpr std::array<char, 64> sixes() {
  std::array<char, 64> table{};
  for (unsigned pixels = 0; pixels < table.size(); ++pixels) {
    unsigned bits = 0;
    for (unsigned i = 0; i < kPixelsPerReplyByte; ++i) bits = bits << 1U | (pixels >> i & 1U);
    table[pixels] = static_cast<char>(bits + kReplyBase);
  }
  return table;
}
constexpr std::array<char, 64> kSixes = sixes();

// Six pixels a byte; the last byte is filled up with 0, as the row's last word is.
char* write_row(std::span<const std::uint64_t> words, std::size_t bytes, char* out) {
  constexpr unsigned kBits = Image::kWordBits;
  unsigned shift = 0;
  std::size_t word = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    std::uint64_t pixels = words[word] >> shift;
    shift += kPixelsPerReplyByte;
    if (shift >= kBits) {
      shift -= kBits;
      ++word;
      if (shift > 0 && word < words.size()) pixels |= words[word] << (kPixelsPerReplyByte - shift);
    }
    *out++ = kSixes[pixels % kSixes.size()];
  }
  return out;
}

void append_rows(const Image& image, std::string& out) {
  const auto bytes =
      static_cast<std::size_t>((image.width() + kPixelsPerReplyByte - 1) / kPixelsPerReplyByte);
  const std::size_t begin = out.size();
  out.resize(begin + bytes * static_cast<std::size_t>(image.height()));
  char* next = out.data() + begin;
  for (int row = 0; row < image.height(); ++row) next = write_row(image.words(row), bytes, next);
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
  void operator()(const CameraRows& rows) const { append_rows(*rows.image, out); }
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
