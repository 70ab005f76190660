#include "core/faults/camera_faults.hpp"

#include <algorithm>
#include <span>

#include "core/faults/chance.hpp"
#include "core/faults/effects.hpp"

namespace xr3 {
namespace {

using Words = std::span<std::uint64_t>;
using ConstWords = std::span<const std::uint64_t>;

constexpr int kPixelsPerWord = Image::kWordBits;

/// The faults of a camera at a tick, as one lens.
struct Lens {
  int columns = 0;
  int rows = 0;
  const FaultState* noise = nullptr;
  std::uint64_t noise_base = 0;  ///< see chance_base()
  std::vector<int> dead_rows;
};

bool is_on_camera(const FaultState& each) {
  return each.is_on && traits_of(each.fault.kind).target == FaultTarget::kCamera;
}

Lens lens_of(const State& state) {
  Lens lens;
  for (const FaultState& each : state.faults.all) {
    if (!is_on_camera(each)) continue;
    const Fault& fault = each.fault;
    if (fault.kind == FaultKind::kCameraNoise && lens.noise == nullptr) lens.noise = &each;
    if (fault.kind == FaultKind::kCameraDeadRow) lens.dead_rows.push_back(fault.row);
    lens.columns += fault.columns;
    lens.rows += fault.rows;
  }
  if (lens.noise != nullptr)
    lens.noise_base = chance_base(lens.noise->salt, static_cast<std::uint64_t>(state.tick));
  return lens;
}

/// 64 pixels from column `first`, which may be outside: there they are 0.
std::uint64_t pixels_from(ConstWords row, int first) {
  const int word = first >= 0 ? first / kPixelsPerWord : -((63 - first) / kPixelsPerWord);
  const auto shift = static_cast<unsigned>(first - word * kPixelsPerWord);
  const auto at = [row](int index) {
    return index >= 0 && static_cast<std::size_t>(index) < row.size()
               ? row[static_cast<std::size_t>(index)]
               : 0;
  };
  return shift == 0 ? at(word) : at(word) >> shift | at(word + 1) << (64 - shift);
}

/// The pixels of a word that noise inverts.
std::uint64_t noise_of(const Lens& lens, std::uint64_t first_pixel) {
  std::uint64_t bits = 0;
  for (unsigned i = 0; i < kPixelsPerWord; ++i) {
    const std::uint64_t hash = chance_after(lens.noise_base, first_pixel + i);
    bits |= std::uint64_t{happens(hash, *lens.noise->fault.chance)} << i;
  }
  return bits;
}

/// Fills row `row` of what the lens shows. Pixels are numbered row by row.
void show(const Lens& lens, const Image& clean, int row, Words result) {
  const bool is_dead =
      std::find(lens.dead_rows.begin(), lens.dead_rows.end(), row) != lens.dead_rows.end();
  if (is_dead) return std::fill(result.begin(), result.end(), 0);
  const int source = row - lens.rows;
  const bool is_inside = source >= 0 && source < clean.height();
  const ConstWords pixels = is_inside ? clean.words(source) : ConstWords{};
  for (std::size_t word = 0; word < result.size(); ++word) {
    const int first = static_cast<int>(word) * kPixelsPerWord;
    result[word] = pixels_from(pixels, first - lens.columns);
    if (lens.noise == nullptr) continue;
    const std::int64_t number = std::int64_t{row} * clean.width() + first;
    result[word] ^= noise_of(lens, static_cast<std::uint64_t>(number));
  }
}

}  // namespace

Image with_camera_faults(const State& state, const Image& clean) {
  const Lens lens = lens_of(state);
  Image image(clean.width(), clean.height());
  for (int row = 0; row < clean.height(); ++row)
    image.set_words(row, [&](Words words) { show(lens, clean, row, words); });
  return image;
}

Image row_with_camera_faults(const State& state, const Image& clean, int row) {
  Image image(clean.width(), 1);
  image.set_words(0, [&](Words words) { show(lens_of(state), clean, row, words); });
  return image;
}

void add_camera_effects(const Model& model, State& state, Events& events) {
  if (!state.faults.now.on_camera) return;
  for (FaultState& each : state.faults.all) {
    if (is_on_camera(each)) add_effect(model, state, each, 0, 0, events);
  }
}

}  // namespace xr3
