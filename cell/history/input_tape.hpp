// The inputs of a part of a cell's history, in little memory: an ordinary poll of a line takes some
// ten bytes.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/recording/entry.hpp"

namespace xr3 {

class InputTape {
 public:
  /// An input of a line, as a recording::LineInput with its time.
  struct TapeInput {
    Epoch epoch = 0;
    Tick tick = 0;
    int us = 0;
    LineId line = 0;
    std::string_view bytes;
    std::size_t taken = 0;
    std::size_t unsent = 0;
  };

  /// Replies and digests of an entry are not kept. Precondition: its time is not before that of the
  /// entry added last.
  void add(recording::Entry&& entry);
  /// The same for the frequent entries, without making one.
  void add(const TapeInput& read);

  /// Calls `use` for each entry, in order, until it returns false.
  void for_each(const std::function<bool(const recording::Entry&)>& use) const;

  /// The number of entries.
  std::size_t size() const { return size_; }
  /// An estimate of its memory.
  std::size_t bytes() const {
    return piece_bytes_ + pieces_.capacity() * sizeof(std::string) + other_bytes_;
  }

 private:
  struct Reader;
  bool is_short(Epoch epoch, Tick tick) const { return epoch == epoch_ && tick >= tick_; }
  void put(const TapeInput& read);
  void put(recording::Entry&& entry);
  void write(std::string_view head, std::string_view bytes);

  std::vector<std::string> pieces_;       ///< inputs of lines, and marks for the others
  std::size_t piece_bytes_ = 0;           ///< their memory
  std::vector<recording::Entry> others_;  ///< in order
  std::size_t other_bytes_ = 0;
  std::size_t size_ = 0;
  Epoch epoch_ = 0;  ///< of the entries in pieces_
  Tick tick_ = 0;    ///< of the last one there
};

}  // namespace xr3
