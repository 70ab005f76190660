// What comes of an input, or of the passing of time: events, records of the lines, bytes for their
// transports, and lines to look at again. It is handed over in parts, so it stays small however
// much an input brings about. Memory is reused.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/explain/cell_event.hpp"
#include "protocol/explain/wire_record.hpp"

namespace xr3 {

/// What happens on the line that is being served, for its records and events.
struct LineTalk {
  std::vector<Exchange> exchanges;
  std::size_t reported = 0;         ///< of exchanges, as events
  std::vector<wire::Item> replies;  ///< that have gone to the outbox, in order

  void clear() {
    exchanges.clear();
    reported = 0;
    replies.clear();
  }
};

class CellOutput {
 public:
  /// Bytes that a line has added to its outbox.
  struct AddedBytes {
    Tick tick = 0;
    LineId line = 0;
    std::string_view bytes;
  };
  /// Takes what has happened so far.
  using Taker = std::function<void(CellOutput&)>;
  /// Is told of each tick in which something may have moved.
  using TickWatcher = std::function<void()>;

  explicit CellOutput(Taker taker) : taker_(std::move(taker)) {}

  /// Passes everything on, and begins anew, even if the taker throws. No effect if it is empty.
  void hand_over();
  /// As hand_over(), but only when there is much.
  void hand_over_if_large() {
    if (events.size() >= kLarge || records_ >= kLarge || bytes_.size() >= kLargeBytes) hand_over();
  }

  /// Empty: ticks need not be made one by one.
  TickWatcher on_tick;

  std::vector<CellEvent> events;
  /// Lines with replies that the transport does not know of, that accept bytes again, or that have
  /// nothing under way any more.
  std::vector<LineId> woken;
  /// The ticks at which the physical controller had not answered in time.
  std::vector<Tick> silences;

  /// A new record, which the caller must fill. Valid until the next call.
  WireRecord& add_record();
  std::span<WireRecord> records() { return {slots_.data(), records_}; }
  std::span<const WireRecord> records() const { return {slots_.data(), records_}; }

  void add_bytes(Tick tick, LineId line, std::string_view bytes);
  template <class Use>
  void for_each_bytes(const Use& use) const {
    for (const Slice& run : runs_)
      use(AddedBytes{run.tick, run.line, std::string_view(bytes_).substr(run.from, run.size)});
  }

  /// It is not handed over, and only valid while a line is served.
  LineTalk talk;

 private:
  static constexpr std::size_t kLarge = 256;
  static constexpr std::size_t kKept = 16;  ///< events and records whose memory is reused
  static constexpr std::size_t kLargeBytes = 64 * 1024;
  struct Slice {
    Tick tick;
    LineId line;
    std::size_t from;
    std::size_t size;
  };

  void clear();
  bool is_empty() const {
    return events.empty() && records_ == 0 && runs_.empty() && woken.empty() && silences.empty();
  }

  Taker taker_;
  std::vector<WireRecord> slots_;  ///< the first `records_` are valid
  std::size_t records_ = 0;
  std::string bytes_;
  std::vector<Slice> runs_;
};

}  // namespace xr3
