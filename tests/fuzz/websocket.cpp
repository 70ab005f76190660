// Fuzzes the WebSocket sessions of the monitor port with the bytes of a client after its handshake,
// through the server's own connections (common/monitor_rig.hpp). Properties: the frames that the
// server sends are well-formed; every message is answered in order and every ping once, as a simple
// reader of RFC 6455 expects; each mistake closes with its status; nothing depends on how the bytes
// arrive; if reading requires the token, no message tells anything of the cell. (A message is at
// most 256 KiB; common/fuzz.cpp bounds the memory.)
//
// Input: as in common/pieces.hpp. A mask of zeros keeps the payload of a frame readable. With
// kQuick there is one conversation, in pieces: of eight sizes of inputs, one is sent to the server
// that needs the token. With kFull there are three, also one with all bytes at once.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/json/source.hpp"
#include "tests/fuzz/common/answers.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/fuzz/common/monitor_rig.hpp"
#include "tests/fuzz/common/pieces.hpp"
#include "tests/fuzz/common/websocket_frames.hpp"

namespace xr3::fuzz::websocket_fuzzer {
namespace {

constexpr std::size_t kMaxTotal = 384UL * 1024;  // one message of the maximum size, and more
constexpr std::size_t kMaxAnswers = 200;         // more only take time
constexpr std::size_t kMaxQuickAnswers = 10;
constexpr std::size_t kClosedInterval = 8;

constexpr const char* kHandshake =
    "GET /ws HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n";
constexpr std::string_view kHeadEnd = "\r\n\r\n";

// --- What the server sends.

struct Received {
  std::vector<std::string> answers;  ///< `result` and `pong`, without hello and channels
  std::vector<std::string> pongs;
  bool shows_the_cell = false;
  std::optional<int> close_code;
};

void add_message(const std::string& text, bool is_first, Received& received) {
  require(is_first == text.starts_with(R"({"op":"hello")"), "the first message is hello");
  received.shows_the_cell |= shows_the_cell(text);
  if (!is_answer(text)) return;
  require(Json::accept(text), "an answer is JSON");
  received.answers.push_back(text);
}

Received received_in(std::string_view bytes) {
  require(bytes.starts_with("HTTP/1.1 101 "), "the handshake is accepted");
  bytes.remove_prefix(bytes.find(kHeadEnd) + kHeadEnd.size());
  Received received;
  bool is_first = true;
  while (const auto frame = take_frame(bytes)) {
    require(!received.close_code, "nothing follows a close frame");
    require(!frame->is_masked && frame->is_final && frame->reserved == 0, "a server's frame");
    require(frame->has_shortest_length, "the length of a server's frame");
    if (frame->opcode == Opcode::kText) add_message(frame->payload, is_first, received);
    if (frame->opcode == Opcode::kText) is_first = false;
    if (frame->opcode == Opcode::kPong) received.pongs.push_back(frame->payload);
    if (frame->opcode == Opcode::kClose) received.close_code = close_code_of(frame->payload);
    require(frame->opcode == Opcode::kText || frame->opcode == Opcode::kPong ||
                frame->opcode == Opcode::kClose,
            "a server sends texts, pongs and a close frame");
  }
  require(bytes.empty(), "the server's last frame is complete");
  return received;
}

// --- What the client can expect.

void check(const Received& received, const ClientStream& sent) {
  require(received.answers.size() <= answers_to(sent.messages), "a message has one answer");
  require(received.pongs.size() <= sent.pings.size(), "a ping has one pong");
  require(std::equal(received.pongs.begin(), received.pongs.end(), sent.pings.begin()),
          "a pong has the payload of its ping");
  if (sent.end == ClientStream::End::kOpen) {
    require(received.answers.size() == answers_to(sent.messages), "every message is answered");
    require(received.pongs.size() == sent.pings.size(), "every ping is answered");
    require(!received.close_code, "a session stays open");
  } else if (sent.end == ClientStream::End::kClosed) {
    require(received.close_code == sent.close_code, "the server closes when the client does");
  }
}

Received converse(MonitorRig& rig, Pieces pieces) {
  pieces.insert(pieces.begin(), kHandshake);
  return received_in(rig.converse(pieces));
}

void check_closed(const Pieces& pieces) {
  require(!converse(MonitorRig::closed(), pieces).shows_the_cell, "reading needs the token");
}

/// All bytes at once are answered like the pieces.
void check_at_once(const Received& in_pieces, std::string_view whole, const ClientStream& sent) {
  const Received at_once = converse(MonitorRig::shared(), {std::string(whole)});
  check(at_once, sent);
  if (sent.end != ClientStream::End::kOpen) return;
  require(in_pieces.answers == at_once.answers, "the answers to divided bytes");
}

void run(std::string_view input, Effort effort) {
  const bool is_full = effort == Effort::kFull;
  const Pieces pieces = pieces_of(input, effort, kMaxTotal);
  const std::string whole = joined(pieces);
  const ClientStream sent = read_client_stream(whole);
  const std::size_t answers = sent.messages.size() + sent.pings.size();
  if (answers > (is_full ? kMaxAnswers : kMaxQuickAnswers)) return;
  if (std::any_of(sent.messages.begin(), sent.messages.end(), would_wait)) return;
  const bool is_closed = input.size() % kClosedInterval == 0;
  if (is_full || is_closed) check_closed(pieces);
  if (!is_full && is_closed) return;
  const Received in_pieces = converse(MonitorRig::shared(), pieces);
  check(in_pieces, sent);
  if (is_full) check_at_once(in_pieces, whole, sent);
}

const Registration kRegistration{{"websocket", kMaxStreamInput, run}};

}  // namespace
}  // namespace xr3::fuzz::websocket_fuzzer
