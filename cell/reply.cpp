#include "cell/reply.hpp"

#include <utility>

#include "cell/advance.hpp"
#include "cell/byte_time.hpp"
#include "cell/events.hpp"

namespace xr3 {
namespace {

void send(CellState& cell, SerialLine& line, std::string_view reply, const wire::Meaning& meaning,
          CellOutput& out) {
  out.talk.replies.push_back(line.send(reply, meaning));
  note_reply(cell, line, reply);
}

}  // namespace

void answer(CellState& cell, SerialLine& line, std::string_view reply, const wire::Meaning& meaning,
            Micros now, CellOutput& out) {
  const State& state = cell.state();
  LineFaults* faults = line.faults();
  if (faults == nullptr || faults->passes_reply(state, reply.size()))
    return pass_on(cell, line, reply, meaning, now, out);
  Carried carried = faults->carry(reply, cell.machine);
  if (carried.bytes.empty()) return;  // it is lost
  if (carried.has_parity_error) line.report_parity_error();
  if (faults->must_wait(state, carried.delay_ms))
    return faults->add(state, carried.delay_ms, {0, std::move(carried.bytes), meaning});
  pass_on(cell, line, carried.bytes, meaning, now, out);
}

void pass_on(CellState& cell, SerialLine& line, std::string_view reply,
             const wire::Meaning& meaning, Micros now, CellOutput& out) {
  if (!line.keeps(reply, meaning, now)) send(cell, line, reply, meaning, out);
}

void release(CellState& cell, SerialLine& line, Micros now, CellOutput& out) {
  record_departed(cell, line, out);
  const OutputMark before = mark_output(line);
  LineFaults* faults = line.faults();
  while (const auto reply = faults->take_due(cell.state()))
    pass_on(cell, line, reply->bytes, reply->meaning, now, out);
  record_output(cell, line, before, out);
  out.woken.push_back(line.id());
}

void send_due(CellState& cell, SerialLine& line, Micros now, CellOutput& out) {
  if (!line.departed().is_followed_by(line.output_end())) record_departed(cell, line, out);
  const std::size_t unsent = line.outbox().size();
  char left = 0;
  const std::optional<wire::Item> reply = line.send_due(left);
  note_reply(cell, line, {&left, 1});
  line.update_input_halt(now);
  ++cell.counters.bytes_out;
  out.add_bytes(cell.tick(), line.id(), line.outbox().substr(unsent));
  if (reply) out.talk.replies.push_back(*reply);
  if (reply || line.departed().bytes.size() >= kMaxShownOut) record_departed(cell, line, out);
  out.woken.push_back(line.id());
}

void control(CellState& cell, SerialLine& line, BufferControl control, Micros now,
             CellOutput& out) {
  switch (control) {
    case BufferControl::kNone: return;
    case BufferControl::kSuspend: return line.suspend(now);
    case BufferControl::kResume: return resume(cell, line, now, out);
    case BufferControl::kDropReplies: return line.drop_replies(now);
    case BufferControl::kDropInput: return line.drop_input();
    case BufferControl::kDropBoth: line.drop_replies(now); return line.drop_input();
  }
}

void resume(CellState& cell, SerialLine& line, Micros now, CellOutput& out) {
  const HeldReplies held = line.resume(now);
  for (const wire::Item& item : held.items) {
    const auto size = item.to - item.from;
    send(cell, line, std::string_view(held.bytes).substr(item.from, size), item.what, out);
  }
}

}  // namespace xr3
