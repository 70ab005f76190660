#include "cli/exec/transcript_text.hpp"

#include <variant>

#include "cell/cell.hpp"
#include "protocol/explain/diagnostic.hpp"

namespace xr3 {

void TranscriptText::begin(const Cell& cell, const Input&) {
  input_at_ = text_.size();
  input_tick_ = cell.state().tick;
}

// Handles the end of an input. Replies to bytes that were executed at their arrival are in the text
// already.
void TranscriptText::end(const Cell&, const Input& input, const Applied& applied) {
  const auto* in = std::get_if<BytesIn>(&input);
  if (in == nullptr || applied.bytes_taken == 0) return;
  const std::string_view taken = in->bytes.substr(0, applied.bytes_taken);
  add(input_at_, {input_tick_, in->line, '>', taken});
}

void TranscriptText::output(const Cell& cell, LineId line, std::string_view bytes) {
  add(text_.size(), {cell.state().tick, line, '<', bytes});
}

void TranscriptText::add(std::size_t at, const Transfer& bytes) {
  if (is_full_) return;
  is_full_ = text_.size() >= kMaxBytes;
  const std::string row = is_full_ ? "# the rest is left out\n"
                                   : std::to_string(bytes.tick) + " " + std::to_string(bytes.line) +
                                         " " + bytes.direction + " " + readable(bytes.text) + "\n";
  text_.insert(is_full_ ? text_.size() : at, row);
}

}  // namespace xr3
