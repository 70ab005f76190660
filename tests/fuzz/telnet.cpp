// Fuzzes one serial line: the detection of HTTP and TLS, the telnet filter and the endpoint.
// Properties: state, replies and exchanges do not depend on how the bytes arrive and when the
// replies are sent; they equal those of a line without telnet that receives the data bytes of a
// simple telnet server with RFC 2217, so only PURGE loses a reply; a client that sends no telnet
// command receives no telnet byte; what a line holds is bounded; no byte of a browser or a TLS
// client acts; the machine's invariants hold.
//
// Input: the first byte selects the profile (bit 0) and the kind of line (bit 1); the rest is as in
// common/pieces.hpp. With kQuick, the bytes of a line with telnet arrive only in pieces, not also
// one by one: the simple server shows whether the pieces matter.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/invariants.hpp"
#include "tests/fuzz/common/fuzz.hpp"
#include "tests/fuzz/common/pieces.hpp"
#include "tests/fuzz/common/telnet_reference.hpp"
#include "tests/support/models.hpp"
#include "tests/support/one_line.hpp"

namespace xr3::fuzz::telnet_fuzzer {
namespace {

constexpr std::size_t kMaxTotal = 4096;  // bytes; a picture fills the outbox with three
constexpr std::size_t kMaxQuickTotal = 128;
constexpr std::size_t kMaxReply = 192 * 192 / 6;  // a picture, in bytes

/// A serial line with its own machine. Collects the replies that the client receives.
class Conversation {
 public:
  Conversation(ModelPtr model, LineKind kind) : one_(std::move(model), kind) {}

  /// Sends all bytes; the client receives at most `at_once` bytes after each receive().
  void send(std::string_view bytes, std::size_t at_once) {
    while (!bytes.empty() && !line().is_not_a_robot_program()) {
      bytes.remove_prefix(one_.receive(bytes));
      keep_exchanges();
      check_bounds();
      if (!bytes.empty() && !line().is_not_a_robot_program()) make_room(bytes.front());
      received_ += one_.fetch(line().is_full() ? SerialLine::kFullOutbox : at_once);
    }
  }
  void fetch_all() { received_ += one_.fetch(); }

  /// The client sends no more and receives everything.
  void finish() {
    one_.end_input();
    check_bounds();
    require(line().held_bytes() == 0, "nothing is held after the end of the input");
    fetch_all();
  }

  const SerialLine& line() const { return one_.line; }
  const State& state() const { return one_.cell.state(); }
  const std::string& received() const { return received_; }
  const std::vector<Exchange>& exchanges() const { return exchanges_; }
  bool has_acted() const {
    return !exchanges_.empty() || !received_.empty() ||
           !(state() == initial_state(one_.cell.model()));
  }
  const char* broken() const { return broken_invariant(one_.cell.model(), state()); }

 private:
  void keep_exchanges() {
    exchanges_.insert(exchanges_.end(), one_.exchanges().begin(), one_.exchanges().end());
  }
  /// A line takes all bytes unless it is full, or the client has suspended too many replies. Such a
  /// client ends its input here: nobody else could make it go on.
  void make_room(char next) {
    if (line().is_full()) return;
    require(!line().accepts(next), "a line takes every byte that it accepts");
    require(line().held_bytes() >= ReplyHold::kFull, "a line waits only with a full hold");
    one_.end_input();
  }
  void check_bounds() const {
    require(line().held_bytes() < ReplyHold::kFull + kMaxReply, "the hold is bounded");
    require(line().outbox().size() < 4 * SerialLine::kFullOutbox, "the outbox is bounded");
  }

  test::OneLine one_;
  std::vector<Exchange> exchanges_;
  std::string received_;
};

// --- Independence of how the bytes arrive.

bool is_same(const Exchange& a, const Exchange& b) {
  return a.parsed == b.parsed && a.reply == b.reply && a.events == b.events;
}

void check_same(const Conversation& a, const Conversation& b) {
  require(a.state() == b.state(), "state of divided bytes");
  require(a.received() == b.received(), "replies to divided bytes");
  require(std::equal(a.exchanges().begin(), a.exchanges().end(), b.exchanges().begin(),
                     b.exchanges().end(), is_same),
          "exchanges of divided bytes");
  require(a.line().is_not_a_robot_program() == b.line().is_not_a_robot_program(), "detection");
  require(a.line().telnet() == b.line().telnet(), "telnet filter of divided bytes");
  require(a.line().bytes_in() == b.line().bytes_in(), "bytes in");
  require(a.line().bytes_out() == b.line().bytes_out(), "bytes out");
}

// --- Telnet.

/// The bytes that the client must receive: a simple telnet server finds the bytes of data, which
/// act on `data_line`, which knows no telnet.
std::string expected_bytes(std::string_view bytes, Conversation& data_line) {
  const auto robot = [&](char byte) {
    const std::size_t before = data_line.received().size();
    data_line.send({&byte, 1}, SerialLine::kFullOutbox);
    data_line.fetch_all();
    return data_line.received().substr(before);
  };
  return TelnetReference(robot, ReplyHold::kFull).all_sent(bytes);
}

// --- Detection.

/// Whether a connection that begins with these bytes is a robot program; undecided while more
/// bytes are needed.
Detection detection_of(std::string_view bytes) {
  HttpTlsDetector detector;
  Detection found = Detection::kUndecided;
  std::size_t fed = 0;
  while (fed < bytes.size() && found == Detection::kUndecided) {
    found = detector.feed(static_cast<std::uint8_t>(bytes[fed++]));
    require(detector.held().size() <= HttpTlsDetector::kMaxHeld, "few bytes are held");
    require(bytes.starts_with(detector.held()), "the first bytes are held");
  }
  return found;
}

void check_detection(std::string_view whole, Detection found) {
  for (const std::string_view opening : {"GET /", "POST /", "OPTIONS *", "CONNECT a:1", "PRI *"}) {
    require(!whole.starts_with(opening) || found == Detection::kNotARobotProgram, "HTTP");
  }
  require(!whole.starts_with("\x16\x03") || found == Detection::kNotARobotProgram, "TLS");
}

// --- All together.

/// A line that detects browsers and speaks telnet.
void check_raw_line(const Conversation& found, std::string_view bytes, const ModelPtr& model) {
  const Detection detection = detection_of(bytes);
  check_detection(bytes, detection);
  require(found.line().is_not_a_robot_program() == (detection == Detection::kNotARobotProgram),
          "the detection of the whole text");
  if (detection != Detection::kPass)
    return require(!found.has_acted(), "no byte of a browser acts");
  Conversation data_line(model, LineKind::kMonitor);
  require(found.received() == expected_bytes(bytes, data_line), "telnet and the replies");
  if (bytes.find('\xff') == std::string_view::npos)
    require(found.received() == data_line.received(), "a raw client receives no telnet byte");
  require(found.state() == data_line.state(), "the state after the data bytes");
  require(found.exchanges().size() == data_line.exchanges().size(), "the data bytes' commands");
}

/// The same bytes one by one; the client receives one byte after each.
void check_bytes(const Conversation& in_pieces, std::string_view whole, const ModelPtr& model,
                 LineKind kind) {
  Conversation in_bytes(model, kind);
  for (const char& byte : whole) in_bytes.send({&byte, 1}, 1);
  in_bytes.finish();
  check_same(in_pieces, in_bytes);
}

void check_line(const Pieces& pieces, const ModelPtr& model, LineKind kind, Effort effort) {
  const std::string whole = joined(pieces);
  Conversation in_pieces(model, kind);
  for (const std::string& piece : pieces) in_pieces.send(piece, SerialLine::kFullOutbox);
  in_pieces.finish();
  if (const char* broken = in_pieces.broken()) require(false, broken);
  if (kind == LineKind::kTcp) check_raw_line(in_pieces, whole, model);
  if (kind != LineKind::kTcp || effort == Effort::kFull) check_bytes(in_pieces, whole, model, kind);
}

ModelPtr model_for(Profile profile) {
  return std::make_shared<const Model>(test::robot_named("rhino-xr3"),
                                       test::workcell_named("rhino-xr3"), profile);
}

void run(std::string_view input, Effort effort) {
  static const ModelPtr models[] = {model_for(Profile::kPaper), model_for(Profile::kMark3)};
  if (input.empty()) return;
  const LineKind kind = (input[0] & 2) == 0 ? LineKind::kTcp : LineKind::kMonitor;
  const std::size_t most = effort == Effort::kFull ? kMaxTotal : kMaxQuickTotal;
  const Pieces pieces = pieces_of(input.substr(1), effort, most);
  check_line(pieces, models[input[0] & 1], kind, effort);
}

const Registration kRegistration{{"telnet", 96, run}};

}  // namespace
}  // namespace xr3::fuzz::telnet_fuzzer
