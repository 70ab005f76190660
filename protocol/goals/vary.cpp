#include "protocol/goals/vary.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>

#include "core/inverse/reach.hpp"
#include "core/workcell.hpp"

namespace xr3 {
namespace {

constexpr Micrometres kGapUm = 5'000;
constexpr int kTries = 2'000;

/// Removes a number from the beginning of a text and returns it; nullopt if there is none, or it is
/// out of range.
std::optional<double> take_number(std::string& text, double most) {
  std::size_t end = 0;
  double number = 0;
  try {
    number = std::stod(text, &end);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  text.erase(0, end);
  return number >= 0 && number <= most ? std::optional(number) : std::nullopt;
}

class Varier {
 public:
  Varier(const Workcell& workcell, const Robot& robot, const Variation& variation)
      : result_(workcell), reach_(robot), variation_(variation), random_(variation.seed) {}

  std::optional<Workcell> run() {
    for (std::size_t i = 0; i < result_.blocks.size(); ++i)
      if (lies_on_surface(result_.blocks[i]) && !place(i)) return std::nullopt;
    return std::move(result_);
  }

 private:
  /// A number in -most...most. Not by a distribution of the library, which differs between
  /// libraries.
  std::int64_t below(std::int64_t most) {
    const auto span = static_cast<std::uint64_t>(2 * most + 1);
    return static_cast<std::int64_t>(random_() % span) - most;
  }

  bool lies_on_surface(const Block& block) const {
    return std::abs(bottom_um(block) - result_.work_surface_um) <= kContactToleranceUm;
  }

  bool place(std::size_t index) {
    const Block original = result_.blocks[index];
    for (int i = 0; i < kTries; ++i) {
      Block block = original;
      block.centroid_um.x += below(variation_.most_um);
      block.centroid_um.y += below(variation_.most_um);
      block.yaw_udeg = normalized(block.yaw_udeg + below(variation_.most_udeg));
      result_.blocks.edit()[index] = block;
      if (is_apart(index) && is_in_view(block) && reach_.has_grasp(block)) return true;
    }
    return false;
  }

  bool is_apart(std::size_t index) const {
    for (std::size_t i = 0; i < result_.blocks.size(); ++i)
      if (i != index && overlaps(result_.blocks[index], result_.blocks[i])) return false;
    return true;
  }
  /// Blocks of which one may stand above the other count, too.
  static bool overlaps(Block a, const Block& b) {
    a.size_um.x += 2 * kGapUm;
    a.size_um.y += 2 * kGapUm;
    return footprint_overlap_um(a, b) > 0;
  }

  /// Whether the whole block is in the camera's field on the work surface.
  bool is_in_view(const Block& block) const {
    if (!result_.camera) return true;
    const Camera& camera = *result_.camera;
    const auto radius = static_cast<Micrometres>(std::ceil(
        std::hypot(static_cast<double>(block.size_um.x), static_cast<double>(block.size_um.y)) /
        2));
    return std::abs(block.centroid_um.x - camera.location_um.x) + radius <= camera.field_x_um / 2 &&
           std::abs(block.centroid_um.y - camera.location_um.y) + radius <= camera.field_y_um / 2;
  }

  Workcell result_;
  Reach reach_;
  Variation variation_;
  std::mt19937_64 random_;
};

}  // namespace

Variation parse_variation(const std::string& text) {
  constexpr double kMaxSeed = 9'007'199'254'740'991;
  constexpr double kMaxMm = 1e5;
  constexpr double kMaxDeg = 180;
  Variation variation;
  std::string rest = text;
  const auto seed = take_number(rest, kMaxSeed);
  bool is_good = seed && *seed == std::floor(*seed);
  if (is_good) variation.seed = static_cast<std::uint64_t>(*seed);
  if (is_good && rest.starts_with(':')) {
    rest.erase(0, 1);
    const auto mm = take_number(rest, kMaxMm);
    is_good = mm.has_value();
    if (mm) variation.most_um = micrometres(*mm);
    if (is_good && rest.starts_with(',')) {
      rest.erase(0, 1);
      const auto degrees = take_number(rest, kMaxDeg);
      is_good = degrees.has_value();
      if (degrees) variation.most_udeg = microdegrees(*degrees);
    }
  }
  if (is_good && rest.empty()) return variation;
  throw std::invalid_argument(
      text + ": a variation is a seed, mm and degrees such as 7, 7:40 or 7:40,180");
}

std::optional<Workcell> varied(const Workcell& workcell, const Robot& robot,
                               const Variation& variation) {
  return Varier(workcell, robot, variation).run();
}

}  // namespace xr3
