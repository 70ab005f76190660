// The client's end of a serial line as text: it parses the sent bytes, as the controller does, and
// thus assigns each received byte to an inquiry. Sans-I/O: the caller measures time and calls
// end_of_burst() and give_up().
//
// The flow through the folder: keystroke.hpp turns the bytes of the user's terminal into keys. Keys
// that are sent at once go to a Typist (typist.hpp), edited lines to a LineEditor
// (line_editor.hpp); both produce a UserRequest (request.hpp): bytes for the robot, a file, a
// break, help, or the end. The caller (cli/term/console.hpp) executes the request. Bytes for the
// robot pass through LineDecoder::send(), which says which of them the controller ignores, before
// they go to the line; received bytes pass through receive(), which decodes each complete reply
// into a sentence with the texts of protocol/explain. Screen (screen.hpp) mixes replies with the
// line being typed, so that neither garbles the other. Scripts use the decoder alone. Nothing here
// waits, and nothing here opens a terminal or a socket.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/explain/reply_decoder.hpp"
#include "protocol/line/rhino_parser.hpp"

namespace xr3::term {

/// Lines of at most 16 bytes such as `> 45 3f 0d`, each with a line feed; `mark` is > for bytes
/// sent and < for bytes received.
std::string hex_lines(char mark, std::string_view bytes);

class LineDecoder {
 public:
  /// The number of unanswered inquiries from which no more bytes should be sent.
  static constexpr std::size_t kMaxUnanswered = 1024;

  explicit LineDecoder(const ReplyContext& context) : context_(context), parser_(context.profile) {}

  /// Handles bytes that are sent now. Returns a sentence for each command in them that the
  /// controller ignores, and one for a run of ignored bytes.
  std::vector<std::string> send(std::string_view bytes);

  /// Handles received bytes. Returns a line for each reply that they complete, such as `45  E: 13
  /// counts to go`, and for bytes that answer nothing.
  std::vector<std::string> receive(std::string_view bytes);

  /// The number of inquiries whose replies are not complete.
  std::size_t unanswered() const { return inquiries_.size(); }

  /// Whether the length of the reply is not known: it ends when no more bytes arrive.
  bool is_in_burst() const;
  /// Completes replies of unknown length. Call when no byte has arrived for a while.
  std::vector<std::string> end_of_burst();

  /// Discards all inquiries. Call when replies are overdue. Returns a sentence, or nothing if there
  /// was no inquiry.
  std::vector<std::string> give_up();

 private:
  struct Inquiry {
    Command command;
    std::string text;  ///< bytes of the inquiry
  };

  std::string line_of(const Inquiry& inquiry, std::string_view bytes) const;
  std::string picture_line(std::size_t bytes);

  ReplyContext context_;
  RhinoParser parser_;
  std::uint64_t sent_ = 0;
  std::deque<Inquiry> inquiries_;
  std::string received_;  ///< beginning of the reply to the first inquiry
};

}  // namespace xr3::term
