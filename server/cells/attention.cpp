#include "server/cells/attention.hpp"

#include <algorithm>
#include <utility>

#include "protocol/explain/command_text.hpp"
#include "protocol/explain/event_report.hpp"
#include "protocol/text/printable.hpp"
#include "server/net/wall_clock.hpp"

namespace xr3 {
namespace {

// The longest command that is shown as it was sent.
constexpr std::size_t kMaxCommand = 16;

}  // namespace

void Attention::describe(monitor::CellSummary& summary) const {
  summary.last_input_at = last_input_;
  summary.last_command = command_;
  summary.last_warning = warning_;
  if (cell_.state().stall != Stall::kNo) summary.stalled_at = stalled_;
}

void Attention::happened(const Cell& cell, const CellOutput& output) {
  for (const WireRecord& record : output.records())
    if (record.direction == Direction::kIn) note(record);
  for (const CellEvent& event : output.events) note(event, cell.model());
}

// --- Commands.

void Attention::note(const WireRecord& record) {
  last_input_ = unix_ms();
  if (std::exchange(begun_line_, record.line) != record.line) begun_.clear();
  begun_ += record.shown;
  const std::uint64_t start = record.offset + record.shown.size() - begun_.size();
  std::uint64_t end = start;
  for (const wire::Item& item : record.items) {
    end = std::max(end, item.to);
    if (const auto* executed = std::get_if<wire::Executed>(&item.what))
      note_command(text_of(item, start, executed->command), is_inquiry(executed->command));
  }
  begun_.erase(0, std::min<std::size_t>(end - start, begun_.size()));
  if (begun_.size() > kMaxCommand) begun_.clear();
}

/// The command as it was sent, or its name. `start`: offset of begun_.
std::string_view Attention::text_of(const wire::Item& item, std::uint64_t start,
                                    const Command& command) const {
  const bool is_kept = item.from >= start && item.to - start <= begun_.size();
  if (!is_kept || item.to - item.from > kMaxCommand) return code_of(command);
  return std::string_view(begun_).substr(item.from - start, item.to - item.from);
}

void Attention::note_command(std::string_view text, bool has_reply) {
  if (!command_) command_.emplace();
  text.remove_suffix(text.size() - (text.find_last_not_of("\r\n") + 1));
  std::string shown = printable_line(text);
  const bool is_same = command_->text == shown;
  *command_ = {std::move(shown), is_same ? command_->count + 1 : 1, has_reply};
}

// --- Events.

void Attention::note(const CellEvent& event, const Model& model) {
  if (std::holds_alternative<EpochNote>(event.note)) forget();
  if (const auto* more = std::get_if<SuppressedNote>(&event.note)) {
    if (warning_) warning_->count += static_cast<std::uint64_t>(more->count);
    return;
  }
  const auto* problem = std::get_if<ProblemNote>(&event.note);
  const auto* body = std::get_if<EventBody>(&event.note);
  if (body != nullptr && std::holds_alternative<Stalled>(*body)) stalled_ = unix_ms();
  if (problem != nullptr)
    return note_warning(problem->code, problem->message,
                        static_cast<std::uint64_t>(problem->count));
  if (body == nullptr || !std::holds_alternative<Warning>(*body)) return;
  EventReport about = report(*body, model);
  note_warning(about.code, std::move(about.message), 1);
}

// Signs from before a reset need no help any more.
void Attention::forget() {
  command_.reset();
  warning_.reset();
  stalled_.reset();
}

void Attention::note_warning(std::string_view code, std::string text, std::uint64_t count) {
  const bool is_same = warning_ && warning_code_ == code;
  warning_code_ = code;
  warning_ = {std::move(text), unix_ms(), is_same ? warning_->count + count : count};
}

}  // namespace xr3
