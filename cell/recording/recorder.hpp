// Turns what a cell tells its log into the entries of a recording, in the order in which a replay
// needs them. Without I/O; a file writer or a memory keeps the entries.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell/cell.hpp"
#include "cell/recording/state_hash.hpp"
#include "protocol/recording/entry.hpp"
#include "protocol/recording/header.hpp"

namespace xr3 {

/// The header of a recording of this cell. Preconditions: no input has acted yet, and the
/// device, if there will be one, is connected.
recording::Header recording_header(const Cell& cell, std::string program);

class Recorder : public CellObserver {
 public:
  using Sink = std::function<void(recording::Entry&&)>;

  /// The first input past each multiple of this tick is recorded with the digest of the state.
  static constexpr Tick kHashEvery = 10'000;
  /// Replies are split into entries of at most so many bytes.
  static constexpr std::size_t kMaxReplies = std::size_t{256} * 1024;

  /// kInputs leaves out replies and digests, which a replay only compares.
  enum class Contents : std::uint8_t { kAll, kInputs };

  explicit Recorder(Sink sink, Contents contents = Contents::kAll)
      : sink_(std::move(sink)), contents_(contents) {}

  /// The last entry: the recording ends at the cell's current tick.
  recording::Entry end_of(const Cell& cell, std::string why);

  void before(const Cell& cell, const Input& input) override;
  void happened(const Cell& cell, const CellOutput& output) override;
  void after(const Cell& cell, const Input& input, const Applied& applied) override;

 protected:
  struct At {
    Epoch epoch = 0;
    Tick tick = 0;
    int us = 0;
  };
  /// The part of an input of bytes that is recorded, without replies. `bytes` refers to the input.
  struct TakenBytes {
    At at;
    std::string_view bytes;
    std::size_t taken = 0;
    std::size_t unsent = 0;
  };
  /// nullopt: nothing of the input is recorded. Precondition: after() of this input.
  std::optional<TakenBytes> read_of(const Cell& cell, const BytesIn& in,
                                    const Applied& applied) const;

 private:
  struct EntryMaker;
  using MaybeBody = std::optional<recording::EntryBody>;

  static At now(const Cell& cell) {
    return {cell.epoch(), cell.state().tick, static_cast<int>(cell.clock_remainder())};
  }
  bool is_hash_due() const;
  void add(const At& at, recording::EntryBody&& body);
  void note_sent(const Cell& cell, const BytesOut& out);
  void add_output(Epoch epoch, const CellOutput::AddedBytes& added);
  void add_outputs();
  std::string take_replies(LineId line);

  Sink sink_;
  Contents contents_;
  StateHasher hasher_;
  At hashed_{0, 0, 0};
  At input_at_;                            ///< of the input that acts
  std::size_t unsent_ = 0;                 ///< of its line, before it
  bool is_first_ = false;                  ///< it is the first read of its line
  bool is_acting_ = false;                 ///< an input
  bool is_open_ = false;                   ///< its line, which the recording has, is open
  std::vector<recording::Entry> outputs_;  ///< not added yet
};

}  // namespace xr3
