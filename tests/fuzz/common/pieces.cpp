#include "tests/fuzz/common/pieces.hpp"

#include <algorithm>

namespace xr3::fuzz {
namespace {

constexpr unsigned kFirstRun = 0xf0;
constexpr std::size_t kRunUnit = 32UL * 1024;
constexpr std::size_t kQuickRunUnit = 32;
constexpr std::size_t kMaxQuickPieces = 5;

/// One piece for each chunk.
Pieces all_pieces_of(std::string_view input, std::size_t run_unit, std::size_t most) {
  Pieces pieces;
  while (input.size() > 1 && most > 0) {
    const auto c = static_cast<unsigned char>(input[0]);
    input.remove_prefix(1);
    const bool is_run = c >= kFirstRun;
    const std::size_t used = is_run ? 1 : std::min<std::size_t>(input.size(), c + 1U);
    const std::size_t size = std::min(most, is_run ? (c - kFirstRun + 1) * run_unit : used);
    pieces.push_back(is_run ? std::string(size, input[0]) : std::string(input.substr(0, size)));
    input.remove_prefix(used);
    most -= size;
  }
  return pieces;
}

/// The same bytes in at most `count` pieces.
void join_beyond(std::size_t count, Pieces& pieces) {
  for (std::size_t i = count; i < pieces.size(); ++i) pieces[count - 1] += pieces[i];
  if (pieces.size() > count) pieces.resize(count);
}

}  // namespace

Pieces pieces_of(std::string_view input, Effort effort, std::size_t most) {
  if (effort == Effort::kFull) return all_pieces_of(input, kRunUnit, most);
  Pieces pieces = all_pieces_of(input, kQuickRunUnit, std::min(most, kMaxQuickBytes));
  join_beyond(kMaxQuickPieces, pieces);
  return pieces;
}

std::string joined(const Pieces& pieces) {
  std::string whole;
  for (const std::string& piece : pieces) whole += piece;
  return whole;
}

}  // namespace xr3::fuzz
