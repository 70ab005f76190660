// The transport of one serial line: passes bytes from its stream to the cell at the tick of their
// arrival, and the line's outbox to the stream. It ends with its stream.
#pragma once

#include <cassert>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cell/cell.hpp"
#include "server/lines/source.hpp"
#include "server/lines/stream.hpp"
#include "server/net/peer_counts.hpp"

namespace xr3 {

class LineTurns;

/// Shared by all sessions of a cell.
struct LineSessionContext {
  Cell& cell;
  LineTurns& turns;
  std::function<void(LineId)> on_input;  ///< called after bytes were executed
  /// Called when the stream is closed; may release the session.
  std::function<void(LineId, LineCloseReason)> ended;
};

class LineSession {
 public:
  /// Opens a line of the cell. `context` and `source` must outlive the session, which keeps `place`
  /// to its end; nullptr if it takes none.
  LineSession(std::unique_ptr<LineStream> stream, const LineOpened& opened,
              LineSessionContext& context, LineSource& source, PeerCounts::Place place);

  LineSource& source() const { return source_; }
  LineId line() const { return id_; }
  int descriptor() const { return stream_->descriptor(); }
  bool is_open() const { return stream_->is_open(); }

  /// The stream has ended or is broken: the next turns read to the end.
  void set_ending() { is_ending_ = true; }
  /// The stream is broken. Bytes that are not due yet are dropped with the line.
  void set_broken() { is_broken_ = true; }

  enum class Turn : std::uint8_t {
    kDrained,  ///< all bytes have been read and executed, all replies sent
    kMore,     ///< there may be more to do now
    kBlocked,  ///< until the next event: replies are not read, the line waits, or it is closed
  };

  /// Sends what can be sent, then reads and executes at most kBytesATurn bytes (kFirstChunk of a
  /// new line), or as many as fit
  /// into kTurnTime, and one piece of 64 bytes or one full outbox more. The clock does not affect
  /// the state: it only decides which bytes belong to the next turn.
  Turn run_turn(WallNs now);
  /// Time after which a reply of a frozen cell leaves. So slow replies, all equal, do not look like
  /// a stuck joint for a lesson's length of time, and no program that reads for 10 s gives up.
  static constexpr WallNs kFrozenReply = 4'000'000'000;
  /// An image costs a thousand times as much as the byte that requests it.
  static constexpr WallNs kTurnTime = 150'000;
  static constexpr std::size_t kBytesATurn = 256;

  /// The number of bytes that have arrived and are not executed yet. 0 if no more will be.
  std::size_t arrived_bytes() const;
  /// LineStream::max_settled().
  std::size_t max_settled() const { return stream_->max_settled(); }
  /// SerialLine::bytes_in(). Precondition: the session is open.
  std::uint64_t bytes_in() const {
    assert(is_open());
    return context_.cell.find_line(id_)->bytes_in();
  }
  /// SerialLine::output_end(). Precondition: the session is open.
  std::uint64_t output_end() const {
    assert(is_open());
    return context_.cell.find_line(id_)->output_end();
  }

  /// The bytes that wait for the client to read.
  std::size_t held_bytes() const;

  /// Reads no more; closes the stream when its replies have been sent.
  void finish();

  /// Closes the stream now.
  void close(LineCloseReason reason);

 private:
  Turn read_and_execute(WallNs now);
  Turn flush(WallNs end);
  bool is_held();
  std::size_t turn_bytes() const;
  std::size_t read(std::size_t most);
  void execute(std::string_view bytes, WallNs end, WallNs now);
  void keep(std::string_view bytes);
  void end_input();
  void end_by_fault();
  void report_settings(WallNs now);

  std::unique_ptr<LineStream> stream_;
  PeerCounts::Place place_;
  LineId id_;
  LineSessionContext& context_;
  LineSource& source_;
  std::string pending_;     ///< read, but not applied because the outbox was full
  bool is_ending_ = false;  ///< the stream ends after the bytes that have arrived
  bool is_broken_ = false;
  bool has_ended_ = false;            ///< no more bytes will be read
  std::optional<WallNs> held_since_;  ///< time of the first reply that waits, if frozen
  LineCloseReason end_ = LineCloseReason::kClientClosed;  ///< the reason, once has_ended_
};

}  // namespace xr3
