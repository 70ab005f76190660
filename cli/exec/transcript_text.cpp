#include "cli/exec/transcript_text.hpp"

#include <variant>

#include "cell/cell.hpp"
#include "protocol/explain/diagnostic.hpp"

namespace xr3 {

void TranscriptText::before(const Cell& cell, const Input& input) {
  if (!std::holds_alternative<BytesIn>(input)) return;
  input_at_ = text_.size();
  input_tick_ = cell.state().tick;
}

// Handles the end of an input. Replies to bytes that were executed at their arrival are in the text
// already.
void TranscriptText::after(const Cell&, const Input& input, const Applied& applied) {
  const auto* in = std::get_if<BytesIn>(&input);
  if (in == nullptr || applied.bytes_taken == 0) return;
  const std::string_view taken = in->bytes.substr(0, applied.bytes_taken);
  add(input_at_, {input_tick_, in->line, '>', taken});
}

void TranscriptText::happened(const Cell&, const CellOutput& output) {
  output.for_each_bytes([this](const CellOutput::AddedBytes& added) {
    add(text_.size(), {added.tick, added.line, '<', added.bytes});
  });
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
