#include "tests/fuzz/common/websocket_frames.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/json/source.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3::fuzz {
namespace {

constexpr std::size_t kKeySize = 4;
constexpr std::uint64_t kMaxControlPayload = 125;
constexpr std::uint64_t kLengthIn2 = 126;
constexpr std::uint64_t kLengthIn8 = 127;
constexpr std::uint64_t kMaxIn2 = 0xffff;

std::uint64_t big_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char byte : bytes) value = value << 8U | static_cast<unsigned char>(byte);
  return value;
}

std::optional<FrameHead> head_of(std::string_view bytes) {
  if (bytes.size() < 2) return std::nullopt;
  const std::uint64_t first = big_endian(bytes.substr(0, 1));
  const std::uint64_t second = big_endian(bytes.substr(1, 1));
  const std::uint64_t length = second & 0x7fU;
  const std::size_t more = length == kLengthIn8 ? 8 : length == kLengthIn2 ? 2 : 0;
  FrameHead head;
  head.opcode = static_cast<Opcode>(first & 0x0fU);
  head.is_final = (first & 0x80U) != 0;
  head.reserved = static_cast<std::uint8_t>(first >> 4U & 7U);
  head.is_masked = (second & 0x80U) != 0;
  head.size = 2 + more + (head.is_masked ? kKeySize : 0);
  if (bytes.size() < head.size) return std::nullopt;
  head.length = more == 0 ? length : big_endian(bytes.substr(2, more));
  head.has_shortest_length =
      more == 0 || (more == 2 ? head.length >= kLengthIn2 : head.length > kMaxIn2);
  return head;
}

std::string unmasked(std::string_view payload, std::string_view key) {
  std::string text(payload);
  for (std::size_t i = 0; i < text.size() && !key.empty(); ++i)
    text[i] = static_cast<char>(text[i] ^ key[i % key.size()]);
  return text;
}

/// The payload as far as it has arrived.
std::string payload_of(const FrameHead& head, std::string_view bytes) {
  const std::size_t key_size = head.is_masked ? kKeySize : 0;
  return unmasked(bytes.substr(head.size, head.length),
                  bytes.substr(head.size - key_size, key_size));
}

bool is_control(Opcode opcode) { return opcode >= Opcode::kClose; }

bool is_known(Opcode opcode) {
  return opcode <= Opcode::kBinary || (is_control(opcode) && opcode <= Opcode::kPong);
}

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return (c & '\x80') == 0; });
}

/// nlohmann's parser accepts a string only if it is UTF-8.
bool is_utf8(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += is_ascii({&c, 1}) ? 'a' : c;
  return Json::accept(quoted + '"');
}

bool is_valid_close(std::string_view payload) {
  if (payload.empty()) return true;
  const int code = close_code_of(payload);
  const bool is_defined = (code >= 1000 && code <= 1003) || (code >= 1007 && code <= 1013);
  return payload.size() >= 2 && (is_defined || code >= 3000) && is_utf8(payload.substr(2));
}

constexpr int kNormal = 1000;
constexpr int kProtocolError = 1002;
constexpr int kUnknownData = 1003;
constexpr int kBadPayload = 1007;
constexpr int kTooBig = 1009;

class Reader {
 public:
  ClientStream read(std::string_view bytes) {
    while (stream_.end == ClientStream::End::kOpen) {
      const auto head = head_of(bytes);
      if (!head) return open();
      if (is_mistake(*head)) return close(kProtocolError);
      const std::size_t room = monitor::kMaxMessageBytes - message_.size();
      if (!is_control(head->opcode) && head->length > room) return close(kTooBig);
      const auto frame = take_frame(bytes);
      if (!frame) return open_in(*head, bytes);
      is_control(frame->opcode) ? handle_control(*frame) : handle_data(*frame);
    }
    return stream_;
  }

 private:
  bool is_mistake(const FrameHead& head) const {
    const bool continues = head.opcode == Opcode::kContinuation;
    if (!is_known(head.opcode) || head.reserved != 0 || !head.is_masked) return true;
    if (!head.has_shortest_length) return true;
    if (is_control(head.opcode)) return !head.is_final || head.length > kMaxControlPayload;
    return continues != is_in_message_;
  }

  void handle_control(const Frame& frame) {
    if (frame.opcode == Opcode::kPing) stream_.pings.push_back(frame.payload);
    if (frame.opcode != Opcode::kClose) return;
    const int echoed = frame.payload.empty() ? kNormal : close_code_of(frame.payload);
    close(is_valid_close(frame.payload) ? echoed : kProtocolError);
  }

  void handle_data(const Frame& frame) {
    if (!is_in_message_) is_text_ = frame.opcode == Opcode::kText;
    message_ += frame.payload;
    is_in_message_ = !frame.is_final;
    if (is_in_message_) return;
    const std::string message = std::exchange(message_, {});
    if (!is_text_) return end(ClientStream::End::kClosed, kUnknownData);
    if (is_utf8(message)) return stream_.messages.push_back(message);
    end(ClientStream::End::kClosed, kBadPayload);
  }

  /// Ends in an incomplete frame.
  ClientStream open_in(const FrameHead& head, std::string_view bytes) {
    if (!is_control(head.opcode)) {
      if (!is_in_message_) is_text_ = head.opcode == Opcode::kText;
      message_ += payload_of(head, bytes);
    }
    return open();
  }
  ClientStream open() {
    if (may_be_invalid()) end(ClientStream::End::kUnknown, 0);
    return stream_;
  }
  ClientStream close(int code) {
    end(may_be_invalid() ? ClientStream::End::kUnknown : ClientStream::End::kClosed, code);
    return stream_;
  }
  /// Whether a server may already know that the incomplete message is no UTF-8.
  bool may_be_invalid() const { return is_text_ && !is_ascii(message_); }

  void end(ClientStream::End how, int code) {
    stream_.end = how;
    stream_.close_code = code;
  }

  ClientStream stream_;
  bool is_in_message_ = false;
  bool is_text_ = false;
  std::string message_;
};

}  // namespace

std::optional<Frame> take_frame(std::string_view& bytes) {
  const auto head = head_of(bytes);
  if (!head || bytes.size() - head->size < head->length) return std::nullopt;
  Frame frame{*head, payload_of(*head, bytes)};
  bytes.remove_prefix(head->size + frame.payload.size());
  return frame;
}

int close_code_of(std::string_view payload) {
  constexpr int kNone = 1005;
  return payload.size() < 2 ? kNone : static_cast<int>(big_endian(payload.substr(0, 2)));
}

ClientStream read_client_stream(std::string_view bytes) { return Reader().read(bytes); }

}  // namespace xr3::fuzz
