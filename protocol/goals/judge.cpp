#include "protocol/goals/judge.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/coupling.hpp"
#include "core/grasp.hpp"
#include "core/kinematics.hpp"
#include "core/workcell.hpp"
#include "protocol/goals/file.hpp"
#include "protocol/goals/goal_text.hpp"
#include "protocol/text/table.hpp"

namespace xr3 {
namespace {

using namespace goal;  // NOLINT: the kinds of goals

/// A judgement: the expected, and what was found if the goal is missed.
struct Judged {
  std::string expected;
  std::optional<std::string> missed = {};
  std::string hint = {};
};

/// The text if the goal is missed.
std::optional<std::string> missed_if(bool is_missed, std::string text) {
  return is_missed ? std::optional(std::move(text)) : std::nullopt;
}

/// The distance of a point from the coordinates that count, rounded to micrometres.
Micrometres distance_um(const PartialPoint& wanted, const PointUm& at) {
  const auto square = [](const std::optional<Micrometres>& want, Micrometres is) {
    const double part = want ? static_cast<double>(*want - is) : 0;
    return part * part;
  };
  return std::llround(
      std::sqrt(square(wanted.x, at.x) + square(wanted.y, at.y) + square(wanted.z, at.z)));
}

PartialPoint moved(const PartialPoint& offset, const PointUm& origin) {
  const auto sum = [](const std::optional<Micrometres>& by, Micrometres from) {
    return by ? std::optional(from + *by) : std::nullopt;
  };
  return {sum(offset.x, origin.x), sum(offset.y, origin.y), sum(offset.z, origin.z)};
}

/// The difference of two yaws; a turn by `period` does not change a block.
Microdegrees yaw_difference(Microdegrees a, Microdegrees b, Microdegrees period) {
  const Microdegrees rest = std::abs(a - b) % period;
  return std::min(rest, period - rest);
}

/// Judges goals, with a function for each kind.
class Judge {
 public:
  Judge(const Model& model, const State& end, const RunFacts& facts)
      : model_(model), end_(end), facts_(facts) {}

  void select(std::size_t index) { breach_ = &facts_.breaches[index]; }

  Judged operator()(const BlockPlace& goal) const {
    Judged result{"block " + goal.name + place_text(goal)};
    const std::optional<std::size_t> index = find(goal.name);
    if (!index) return missing(std::move(result), goal.name);
    if (is_held(*index) && !goal.may_be_held) {
      result.missed = "the jaws hold it";
      result.hint = "open the jaws before the program ends";
      return result;
    }
    result.missed = place_missed(goal, now(*index));
    if (!result.missed) result.missed = yaw_missed(goal, now(*index));
    return result;
  }

  Judged operator()(const Stacked& goal) const {
    Judged result{"block " + goal.name + " on block " + goal.on};
    const auto upper = find(goal.name);
    const auto lower = find(goal.on);
    if (!upper || !lower) return missing(std::move(result), upper ? goal.on : goal.name);
    if (is_held(*upper) || is_held(*lower)) {
      result.missed = "the jaws hold " + (is_held(*upper) ? goal.name : goal.on);
      return result;
    }
    const Block& top = end_.blocks[*upper];
    const Block& base = end_.blocks[*lower];
    const Micrometres gap = bottom_um(top) - top_um(base);
    const bool is_beside = footprint_overlap_um(top, base) <= kContactToleranceUm;
    if (is_beside || std::abs(gap) > kContactToleranceUm)
      result.missed = "it is at " + point_text(top.centroid_um) + ", and " + goal.on + " at " +
                      point_text(base.centroid_um) +
                      (is_beside ? "" : "; the gap is " + mm_text(gap) + " mm");
    return result;
  }

  Judged operator()(const Sorted& goal) const {
    Judged result{sorted_text(goal)};
    std::vector<Block> blocks;
    for (std::size_t i = 0; i < end_.blocks.size(); ++i)
      if (is_one_of(goal.names, end_.blocks[i].name)) blocks.push_back(now(i));
    std::stable_sort(blocks.begin(), blocks.end(), [&](const Block& a, const Block& b) {
      return coordinate(goal.along, a) < coordinate(goal.along, b);
    });
    for (std::size_t i = 1; i < blocks.size(); ++i)
      if (!result.missed && key(goal.by, blocks[i]) < key(goal.by, blocks[i - 1]))
        result.missed = "block " + blocks[i - 1].name + " comes before block " + blocks[i].name;
    return result;
  }

  Judged operator()(const Holding& goal) const {
    const std::string held = end_.held ? end_.blocks[end_.held->block].name : "";
    return {goal.name ? "the jaws hold block " + *goal.name : "the jaws hold nothing",
            missed_if(goal.name ? held != *goal.name : end_.held.has_value(),
                      end_.held ? "they hold " + held : "they hold nothing")};
  }

  Judged operator()(const JointValue& goal) const {
    const int index = model_.index_of(goal.label);
    const char* unit = goal.count ? " counts" : model_.is_length(index) ? " mm" : " degrees";
    const double wanted = goal.count ? *goal.count : *goal.value;
    const Counts position = positions(model_, end_.motors)[static_cast<std::size_t>(index)];
    const double found = goal.count ? end_.motor(index).count : model_.variable(index, position);
    // Rounded, so that a limit of 0.1 is not missed by the last bit.
    constexpr double kParts = 1e6;
    const bool is_met =
        std::llround(std::abs(found - wanted) * kParts) <= std::llround(goal.within * kParts);
    return {"joint " + std::string(1, goal.label) + " at " + plain_number(wanted, 4) + unit +
                ", within " + plain_number(goal.within, 4),
            missed_if(!is_met, "it is at " + plain_number(found, 4) + unit)};
  }

  Judged operator()(const TipPlace& goal) const {
    const PointUm tip = tool_tip(model_, positions(model_, end_.motors));
    return {"tool tip at " + point_text(goal.point) + ", within " + mm_text(goal.within_um) + " mm",
            point_missed(goal.point, goal.within_um, tip)};
  }

  Judged operator()(const NoStall&) const {
    return {"the robot never stalls",
            missed_if(facts_.stall.has_value(),
                      "it stalled " + at_text(facts_.stall_tick) + ": the tool tip entered " +
                          (facts_.stall == Stall::kWorkSurface ? "the work surface"
                                                               : "the protected region"))};
  }

  Judged operator()(const NoWarnings&) const {
    Judged result{"no warnings"};
    if (facts_.problem_count == 0) return result;
    const RunProblem& first = facts_.problems.front();
    result.missed = std::to_string(facts_.problem_count) +
                    (facts_.problem_count == 1 ? " warning: " : " warnings, first ") +
                    first.message + " (" + first.code + ") " + at_text(first.tick) + other_codes();
    return result;
  }

  Judged operator()(const NoSoftHome&) const {
    const auto& tick = facts_.soft_home_tick;
    return {"the controller's soft home (A$) is not used",
            missed_if(tick.has_value(), "it was used " + at_text(tick.value_or(0)))};
  }

  Judged operator()(const Untouched& goal) const {
    const Breach breach = breach_->value_or(Breach{});
    return {names_text(goal.names) + " not moved by more than " + mm_text(goal.within_um) + " mm",
            missed_if(breach_->has_value(),
                      "block " + breach.block + " was moved " + at_text(breach.tick))};
  }

  Judged operator()(const KeepOut& goal) const {
    const Breach breach = breach_->value_or(Breach{});
    return {"tool tip never in the box " + box_text(goal.box),
            missed_if(breach_->has_value(),
                      "it was at " + point_text(breach.at) + " " + at_text(breach.tick))};
  }

  Judged operator()(const Order& goal) const {
    Judged result{"in this order: " + names_text(goal.events)};
    auto at = facts_.happenings.begin();
    for (const std::string& event : goal.events) {
      at = std::find(at, facts_.happenings.end(), event);
      if (at == facts_.happenings.end()) {
        result.missed = "\"" + event + "\" did not happen, or not after what comes before it";
        break;
      }
      ++at;
    }
    return result;
  }

  Judged operator()(const MaxSimTime& goal) const {
    return {"the last motion after at most " + seconds_text(goal.ticks) + " simulated s",
            missed_if(facts_.last_count_tick > goal.ticks,
                      "it was " + at_text(facts_.last_count_tick))};
  }

  Judged operator()(const MaxBytes& goal) const {
    return {
        "at most " + std::to_string(goal.bytes) + " bytes sent",
        missed_if(facts_.bytes > goal.bytes, std::to_string(facts_.bytes) + " bytes were sent")};
  }

  Judged operator()(const MaxTipPath& goal) const {
    return {"the tool tip moves at most " + mm_text(goal.length_um) + " mm",
            missed_if(facts_.tip_path_um > goal.length_um,
                      "it moved " + mm_text(facts_.tip_path_um) + " mm")};
  }

 private:
  std::optional<std::size_t> find(const std::string& name) const {
    const auto& all = end_.blocks;
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const Block& each) { return each.name == name; });
    if (at == all.end()) return std::nullopt;
    return static_cast<std::size_t>(at - all.begin());
  }
  bool is_held(std::size_t index) const { return end_.held && end_.held->block == index; }
  /// A block at its current place; a held one as it would lie if released.
  Block now(std::size_t index) const {
    if (!is_held(index)) return end_.blocks[index];
    return as_released(model_, end_, *end_.held, positions(model_, end_.motors));
  }
  static Judged missing(Judged result, const std::string& name) {
    result.missed = "there is no block " + name + " any more";
    return result;
  }
  /// The next kinds of problems after the first.
  std::string other_codes() const {
    constexpr std::size_t kMostShown = 4;
    std::string text;
    for (std::size_t i = 1; i < std::min(facts_.problems.size(), kMostShown); ++i)
      text += (text.empty() ? "; then " : ", ") + facts_.problems[i].code;
    return text;
  }

  static std::string at_text(Tick tick) { return "after " + seconds_text(tick) + " s"; }

  static std::string place_text(const BlockPlace& goal) {
    std::string text;
    const std::string within = ", within " + mm_text(goal.within_um) + " mm";
    if (goal.point) text += " at " + point_text(*goal.point) + within;
    if (goal.box) text += " in the box " + box_text(*goal.box);
    if (!goal.at.empty())
      text += goal.offset == PartialPoint{}
                  ? " at block " + goal.at + within
                  : " at " + point_text(goal.offset) + " from block " + goal.at + within;
    if (goal.yaw_udeg)
      text += ", yaw " + degrees_text(*goal.yaw_udeg) + " degrees, within " +
              degrees_text(goal.within_udeg);
    return text;
  }

  std::optional<std::string> place_missed(const BlockPlace& goal, const Block& block) const {
    if (goal.point) return point_missed(*goal.point, goal.within_um, block.centroid_um);
    if (goal.box && !goal.box->contains(block.centroid_um))
      return "it is at " + point_text(block.centroid_um);
    if (goal.at.empty()) return std::nullopt;
    const std::optional<std::size_t> other = find(goal.at);
    if (!other) return "there is no block " + goal.at + " any more";
    const PointUm origin = now(*other).centroid_um;
    const bool is_same = goal.offset == PartialPoint{};
    const PartialPoint offset = is_same ? PartialPoint{0, 0, std::nullopt} : goal.offset;
    return point_missed(moved(offset, origin), goal.within_um, block.centroid_um);
  }

  static std::optional<std::string> point_missed(const PartialPoint& wanted, Micrometres within,
                                                 const PointUm& at) {
    const Micrometres away = distance_um(wanted, at);
    if (away <= within) return std::nullopt;
    return "it is at " + point_text(at) + ", " + mm_text(away) + " mm away";
  }

  static std::optional<std::string> yaw_missed(const BlockPlace& goal, const Block& block) {
    if (!goal.yaw_udeg) return std::nullopt;
    constexpr Microdegrees kQuarter = 90'000'000;
    const Microdegrees period = block.size_um.x == block.size_um.y ? kQuarter : 2 * kQuarter;
    if (yaw_difference(*goal.yaw_udeg, block.yaw_udeg, period) <= goal.within_udeg)
      return std::nullopt;
    return "its yaw is " + degrees_text(block.yaw_udeg) + " degrees";
  }

  static bool is_one_of(const std::vector<std::string>& names, const std::string& name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  }
  static std::string sorted_text(const Sorted& goal) {
    constexpr const char* kKeys[] = {"size", "height", "color"};
    constexpr const char* kAxes[] = {"x", "-x", "y", "-y"};
    return (goal.names.empty() ? "all blocks" : names_text(goal.names)) + " sorted by " +
           kKeys[static_cast<int>(goal.by)] + " along " + kAxes[static_cast<int>(goal.along)];
  }
  static Micrometres coordinate(SortAxis axis, const Block& block) {
    switch (axis) {
      case SortAxis::kX: return block.centroid_um.x;
      case SortAxis::kMinusX: return -block.centroid_um.x;
      case SortAxis::kY: return block.centroid_um.y;
      case SortAxis::kMinusY: break;
    }
    return -block.centroid_um.y;
  }
  /// Volumes as doubles: exact for blocks up to 20 cm, and in any case the same on every machine.
  static double key(SortKey by, const Block& block) {
    const auto volume = static_cast<double>(block.size_um.x) *
                        static_cast<double>(block.size_um.y) * static_cast<double>(block.size_um.z);
    return by == SortKey::kSize     ? volume
           : by == SortKey::kHeight ? static_cast<double>(block.size_um.z)
                                    : static_cast<double>(block.color);
  }

  const Model& model_;
  const State& end_;
  const RunFacts& facts_;
  const std::optional<Breach>* breach_ = nullptr;
};

}  // namespace

std::vector<GoalResult> judge(const GoalList& list, const Model& model, const State& end,
                              const RunFacts& facts) {
  assert(facts.breaches.size() == list.goals.size());
  Judge judge(model, end, facts);
  std::vector<GoalResult> results;
  for (const Goal& goal : list.goals) {
    judge.select(results.size());
    Judged judged = std::visit(judge, goal.body);
    GoalResult result{!judged.missed,
                      goal.points,
                      kind_of(goal),
                      std::move(judged.expected),
                      judged.missed.value_or(""),
                      ""};
    if (!result.is_met) result.hint = goal.hint.empty() ? judged.hint : goal.hint;
    results.push_back(std::move(result));
  }
  return results;
}

int points_of(const std::vector<GoalResult>& results) {
  int points = 0;
  for (const GoalResult& each : results) points += each.earned();
  return points;
}

int max_points_of(const std::vector<GoalResult>& results) {
  int points = 0;
  for (const GoalResult& each : results) points += each.points;
  return points;
}

}  // namespace xr3
