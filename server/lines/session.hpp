// The transport of one serial line: passes bytes from its stream to the cell at the tick of their
// arrival, and the line's outbox to the stream. It ends with its stream.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cell/cell.hpp"
#include "server/lines/load.hpp"
#include "server/lines/source.hpp"
#include "server/lines/stream.hpp"
#include "server/lines/turn_queue.hpp"
#include "server/net/peer_counts.hpp"

namespace xr3 {

class LineTurns;

/// Shared by all sessions of a cell.
struct LineSessionContext {
  Cell& cell;
  LineTurns& turns;
  std::function<void(LineId)> acted;  ///< called after bytes have acted
  /// Called when the stream is closed; may release the session.
  std::function<void(LineId, LineCloseReason)> ended;
};

class LineSession {
 public:
  /// Opens a line of the cell. `context` and `source` must outlive the session, which keeps `place`
  /// to its end; null: it takes no place, and shares its turns with no other line.
  LineSession(std::unique_ptr<LineStream> stream, const LineOpened& opened,
              LineSessionContext& context, LineSource& source, PeerCounts::Place place);

  LineSource& source() const { return source_; }
  LineId line() const { return id_; }
  int descriptor() const { return stream_->descriptor(); }
  bool is_open() const { return is_open_; }

  /// The stream has ended or is broken: the next turns read to the end.
  void note_end() { is_ending_ = true; }
  /// The stream is broken. Bytes that are not due yet are dropped with the line.
  void note_loss() { is_broken_ = true; }

  /// Sends what can be sent, then reads and applies bytes up to the limits of a turn, which begins
  /// `now`. Returns whether there may be more to do.
  bool run_turn(WallNs now);

  /// The load of a new line: its first turns wait for those of lines that only ask, since to open,
  /// to examine and to close a line costs much more than an inquiry.
  static constexpr std::uint64_t kNewLoad = 15'000;
  /// LineLoad::at().
  std::uint64_t load(WallNs now) { return load_.at(now); }
  /// The lines of one address share it.
  TurnQueue::Peer& peer() { return *peer_; }

  /// The limits of a turn, or of a barrier: the bytes that have arrived before a call. Bytes act
  /// until one of them is reached.
  struct Limits {
    std::size_t most_read;     ///< bytes
    std::uint64_t output_end;  ///< the line's output_end()
    WallNs end;
    bool is_burst = false;  ///< reading ends when a read gives nothing
  };

  /// The limits of the bytes that have arrived and must act before a call. With the byte clock,
  /// their time is limited, too. Precondition: the line exists.
  Limits arrived_limits() const;
  static constexpr std::size_t kMaxArrived = 512 * 1024;
  static constexpr std::size_t kMaxAnswered = 1024 * 1024;

  /// Applies at most `most` bytes that have arrived, and takes them off the limits, until replies
  /// wait for the client. With the byte clock, none of a line that waits. Returns whether there may
  /// be more to do now.
  bool read_arrived(Limits& limits, std::size_t most);

  /// Precondition: the line exists.
  bool is_over(const Limits& limits, WallNs now) const;

  /// The bytes that wait for the client to read.
  std::size_t held_bytes() const;

  /// Reads no more; closes the stream when its replies have been sent.
  void finish();

  /// Closes the stream now.
  void close(LineCloseReason reason);

 private:
  enum class Left : std::uint8_t { kNothing, kSome, kWaits };  ///< kWaits: for news

  Left work(Limits& limits, WallNs now);
  Left read_and_act(Limits& limits, WallNs now);
  Left flush(const Limits& limits, WallNs now);
  bool moves_time() const;
  std::size_t fair_share() const;
  void note_load(std::uint64_t bytes_in, std::uint64_t bytes_out);
  std::size_t read(std::size_t most);
  void act(std::string_view bytes, const Limits& limits, WallNs now);
  void keep(std::string_view bytes);
  void end_input();
  void end_by_fault();
  void report_settings(WallNs now);

  std::unique_ptr<LineStream> stream_;
  PeerCounts::Place place_;
  std::shared_ptr<TurnQueue::Peer> peer_;
  LineId id_;
  LineSessionContext& context_;
  LineSource& source_;
  LineLoad load_;
  std::string pending_;     ///< read, but not applied because the outbox was full
  bool is_open_ = true;     ///< as stream_->is_open(), without a virtual call
  bool is_ending_ = false;  ///< the stream ends after the bytes that have arrived
  bool is_broken_ = false;
  bool has_ended_ = false;                                ///< no more bytes will be read
  LineCloseReason end_ = LineCloseReason::kClientClosed;  ///< the reason, once has_ended_
};

}  // namespace xr3
