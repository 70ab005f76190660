#include "cell/history/input_tape.hpp"

#include <cassert>
#include <utility>

#include "cell/history/heap_size.hpp"

namespace xr3 {
namespace {

using recording::Entry;
using recording::LineInput;

// Numbers are written with 7 bits a byte, the lowest first; the highest bit says that more follow.
constexpr unsigned kBits = 7;
constexpr unsigned kMore = 1U << kBits;

// What stands in the bytes of a tape.
constexpr char kOther = 0;  ///< the next one of the other entries
constexpr char kInput = 1;  ///< an input of a line: its numbers and bytes follow

/// An estimate of the memory of an entry outside of itself.
struct HeapOf {
  std::size_t operator()(const recording::LineBegin& begin) const { return begin.peer.capacity(); }
  std::size_t operator()(const LineInput& input) const { return input.bytes.capacity(); }
  std::size_t operator()(const recording::CallMade& made) const {
    return std::visit(*this, made.call);
  }
  std::size_t operator()(const call::ReplaceWorkcell& replace) const {
    return heap_of(replace.workcell);
  }
  std::size_t operator()(const call::AddBlock& add) const { return add.block.name.capacity(); }
  std::size_t operator()(const call::LoadSnapshot& load) const {
    if (!load.saved) return 0;
    const State& state = load.saved->state;
    return sizeof(SavedCell) + heap_of(load.saved->workcell) + heap_of(state.blocks) +
           heap_of(state.tip_path);
  }
  template <class Other>
  std::size_t operator()(const Other&) const {
    return 0;
  }
};

}  // namespace

/// Reads the entries from the bytes.
struct InputTape::Reader {
  const InputTape& tape;
  std::size_t at = 0;
  std::size_t other = 0;
  Tick tick = 0;

  std::uint64_t number() {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += kBits) {
      const auto byte = static_cast<unsigned char>(tape.bytes_[at++]);
      value |= static_cast<std::uint64_t>(byte & (kMore - 1)) << shift;
      if (byte < kMore) return value;
    }
  }

  Entry input() {
    tick += static_cast<Tick>(number());
    const auto us = static_cast<int>(number());
    LineInput input;
    input.line = static_cast<LineId>(number());
    const auto count = static_cast<std::size_t>(number());
    input.taken = count - static_cast<std::size_t>(number());
    input.unsent = static_cast<std::size_t>(number());
    input.bytes = tape.bytes_.substr(at, count);
    at += count;
    return {tape.epoch_, tick, us, std::move(input)};
  }
};

void InputTape::for_each(const std::function<bool(const recording::Entry&)>& use) const {
  for (Reader reader{*this}; reader.at < bytes_.size();) {
    const bool is_other = bytes_[reader.at++] == kOther;
    if (!use(is_other ? others_[reader.other++] : reader.input())) return;
  }
}

bool InputTape::is_short(const recording::Entry& entry) const {
  return std::holds_alternative<LineInput>(entry.body) && entry.epoch == epoch_ &&
         entry.tick >= tick_;
}

void InputTape::put(std::uint64_t number) {
  for (; number >= kMore; number >>= kBits)
    bytes_.push_back(static_cast<char>((number & (kMore - 1)) | kMore));
  bytes_.push_back(static_cast<char>(number));
}

void InputTape::add(recording::Entry&& entry) {
  if (size_++ == 0) epoch_ = entry.epoch;
  if (!is_short(entry)) {
    bytes_.push_back(kOther);
    other_bytes_ += sizeof(Entry) + std::visit(HeapOf{}, entry.body);
    others_.push_back(std::move(entry));
    return;
  }
  const auto& input = std::get<LineInput>(entry.body);
  assert(input.taken <= input.bytes.size());
  bytes_.push_back(kInput);
  put(static_cast<std::uint64_t>(entry.tick - std::exchange(tick_, entry.tick)));
  put(static_cast<std::uint64_t>(entry.us));
  put(input.line);
  put(input.bytes.size());
  put(input.bytes.size() - input.taken);
  put(input.unsent);
  bytes_ += input.bytes;
}

}  // namespace xr3
