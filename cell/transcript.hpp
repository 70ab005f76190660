// The transcript of a cell since its epoch began: for each line, every byte of data in and out with
// its tick, then the state. Only a running SHA-256 of each line is kept, so its memory is bounded.
// Two runs with equal digests have had the same conversations at the same simulated times, however
// the bytes were cut into packets. It holds no messages, peers, line numbers or wall time.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/model.hpp"
#include "core/state.hpp"
#include "protocol/explain/cell_event.hpp"
#include "protocol/line/line_speed.hpp"

namespace xr3 {

/// Why a transcript may differ although the programs have sent the same bytes.
enum class TranscriptMark : std::uint8_t {
  kArrivalOrder,  ///< several lines were obeyed together, in the order in which their bytes arrived
  kNotBytesAlone,  ///< a call has changed the cell or its time, or a connection was aborted
  kSilence,        ///< silence in wall time has run the robot to rest
};
inline constexpr std::size_t kTranscriptMarks =
    static_cast<std::size_t>(TranscriptMark::kSilence) + 1;

/// The name in messages: `arrival_order`, `not_bytes_alone` or `silence`.
std::string_view name_of(TranscriptMark mark);

/// What a transcript tells, without the state at its end.
struct TranscriptSummary {
  std::string lines_digest;  ///< of all bytes, with their lines and ticks
  std::uint64_t lines = 0;   ///< that have had a byte of data
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
  std::vector<TranscriptMark> marks;  ///< each at most once, in the order of the enumeration
  bool operator==(const TranscriptSummary&) const = default;
};

/// The digest of the whole transcript: `sha256:` and 64 digits. `remainder` is that of the byte
/// clock.
std::string transcript_digest(const TranscriptSummary& summary, const Model& model,
                              const State& state, Micros remainder);

class Transcript {
 public:
  /// A byte of data acts at this tick.
  void add_in(LineId line, Tick tick, std::uint8_t byte);
  /// Bytes of a reply leave at this tick, before the telnet filter.
  void add_out(LineId line, Tick tick, std::string_view reply);
  /// The line has closed. The order in which lines close does not matter.
  void end_line(LineId line);
  void mark(TranscriptMark mark) { marks_.at(static_cast<std::size_t>(mark)) = true; }

  /// Forgets everything: a new epoch begins. Lines that are open begin anew with their next byte.
  void restart() { *this = {}; }

  TranscriptSummary summary() const;

  bool operator==(const Transcript&) const = default;

 private:
  /// The bytes of one line so far.
  class OneLine {
   public:
    explicit OneLine(std::uint64_t number) : number_(number) {}
    void add(Tick tick, bool is_out, std::string_view bytes);
    std::string digest() const;
    bool operator==(const OneLine&) const = default;

   private:
    void put(std::uint64_t number);
    void fold();

    std::uint64_t number_;  ///< of the lines with bytes, from 1
    Tick last_ = 0;         ///< tick of the last record
    std::string chain_;     ///< the digest of all records before rest_
    std::string rest_;
  };
  /// Sum without carry of digests: the same in any order.
  using Sum = std::array<std::uint8_t, 64>;

  OneLine& find(LineId line);
  static void add(const std::string& digest, Sum& sum);

  std::map<LineId, OneLine> open_;
  Sum closed_{};
  std::uint64_t lines_ = 0;
  std::uint64_t bytes_in_ = 0;
  std::uint64_t bytes_out_ = 0;
  std::array<bool, kTranscriptMarks> marks_{};
};

}  // namespace xr3
