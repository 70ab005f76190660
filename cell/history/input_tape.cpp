#include "cell/history/input_tape.hpp"

#include <array>
#include <cassert>
#include <iterator>
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

constexpr std::size_t kMostDigits = (64 + kBits - 1) / kBits;

// A piece has at least so many bytes before the next one begins.
constexpr std::size_t kPiece = 4096;

/// Writes a number with kBits of it in each byte, the lowest first. Returns the end.
char* pack(std::uint64_t number, char* to) {
  for (; number >= kMore; number >>= kBits)
    *to++ = static_cast<char>((number & (kMore - 1)) | kMore);
  *to++ = static_cast<char>(number);
  return to;
}

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

/// Reads the entries of one piece.
struct InputTape::Reader {
  const InputTape& tape;
  std::string_view rest;
  std::size_t other;
  Tick tick;

  std::uint64_t number() {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += kBits) {
      const auto byte = static_cast<unsigned char>(rest.front());
      rest.remove_prefix(1);
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
    input.bytes = rest.substr(0, count);
    rest.remove_prefix(count);
    return {tape.epoch_, tick, us, std::move(input)};
  }

  /// Returns whether there is more.
  bool read(const std::function<bool(const recording::Entry&)>& use) {
    while (!rest.empty()) {
      const bool is_other = rest.front() == kOther;
      rest.remove_prefix(1);
      if (!use(is_other ? tape.others_[other++] : input())) return false;
    }
    return true;
  }
};

void InputTape::for_each(const std::function<bool(const recording::Entry&)>& use) const {
  Reader reader{*this, {}, 0, 0};
  for (const std::string& piece : pieces_) {
    reader.rest = piece;
    if (!reader.read(use)) return;
  }
}

void InputTape::add(recording::Entry&& entry) {
  if (size_++ == 0) epoch_ = entry.epoch;
  const auto* input = std::get_if<LineInput>(&entry.body);
  if (input == nullptr || !is_short(entry.epoch, entry.tick)) return put(std::move(entry));
  put(TapeInput{entry.epoch, entry.tick, entry.us, input->line, input->bytes, input->taken,
                input->unsent});
}

void InputTape::add(const TapeInput& read) {
  if (size_++ == 0) epoch_ = read.epoch;
  if (is_short(read.epoch, read.tick)) return put(read);
  put(Entry{read.epoch, read.tick, read.us,
            LineInput{read.line, std::string(read.bytes), read.taken, read.unsent, {}}});
}

void InputTape::put(recording::Entry&& entry) {
  write({&kOther, 1}, {});
  other_bytes_ += sizeof(Entry) + std::visit(HeapOf{}, entry.body);
  others_.push_back(std::move(entry));
}

void InputTape::put(const TapeInput& read) {
  assert(read.taken <= read.bytes.size());
  const std::uint64_t passed = static_cast<std::uint64_t>(read.tick - tick_);
  tick_ = read.tick;
  const std::uint64_t numbers[] = {passed,
                                   static_cast<std::uint64_t>(read.us),
                                   read.line,
                                   read.bytes.size(),
                                   read.bytes.size() - read.taken,
                                   read.unsent};
  std::array<char, 1 + std::size(numbers) * kMostDigits> packed;
  char* end = packed.data();
  *end++ = kInput;
  for (const std::uint64_t number : numbers) end = pack(number, end);
  write({packed.data(), static_cast<std::size_t>(end - packed.data())}, read.bytes);
}

// One long piece would be copied again and again while it grows.
void InputTape::write(std::string_view head, std::string_view bytes) {
  if (pieces_.empty() || pieces_.back().size() >= kPiece) pieces_.emplace_back();
  std::string& piece = pieces_.back();
  const std::size_t before = piece.capacity();
  piece.append(head);
  piece.append(bytes);
  piece_bytes_ += piece.capacity() - before;
}

}  // namespace xr3
