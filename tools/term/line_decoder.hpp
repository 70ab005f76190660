// The client's end of a serial line as text: it parses what is sent, as the controller does, and so
// knows which inquiry each received byte answers. Sans-I/O: the caller tells the time by
// end_of_burst() and give_up().
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
  /// With so many unanswered inquiries no more bytes should be sent.
  static constexpr std::size_t kMaxUnanswered = 1024;

  explicit LineDecoder(const ReplyContext& context) : context_(context), parser_(context.profile) {}

  /// Handles bytes that are sent now. Returns a sentence for each command in them that the
  /// controller ignores, and one for a run of ignored bytes.
  std::vector<std::string> send(std::string_view bytes);

  /// Handles received bytes. Returns a line for each reply that they complete, such as
  /// `45  E: 13 counts to go`, and for bytes that answer nothing.
  std::vector<std::string> receive(std::string_view bytes);

  /// Inquiries whose replies are not complete.
  std::size_t unanswered() const { return inquiries_.size(); }

  /// Whether the length of the reply is not known: it ends when no more bytes come.
  bool is_in_burst() const;
  /// No byte has come for a while: completes replies of unknown length.
  std::vector<std::string> end_of_burst();

  /// Replies are overdue: forgets all inquiries. Returns a sentence, or nothing if there was none.
  std::vector<std::string> give_up();

 private:
  struct Inquiry {
    Command command;
    std::string text;  ///< its bytes
  };

  std::string line_of(const Inquiry& inquiry, std::string_view bytes) const;
  std::string picture_line(std::size_t bytes);

  ReplyContext context_;
  RhinoParser parser_;
  std::uint64_t sent_ = 0;
  std::deque<Inquiry> inquiries_;
  std::string received_;  ///< the beginning of the reply to the first inquiry
};

}  // namespace xr3::term
