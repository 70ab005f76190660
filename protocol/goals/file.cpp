#include "protocol/goals/file.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/files/block.hpp"
#include "protocol/files/faults.hpp"
#include "protocol/files/kind.hpp"
#include "protocol/files/workcell.hpp"

namespace xr3 {
namespace {

using namespace data;  // NOLINT: keeps the tables below readable
using namespace goal;  // NOLINT: keeps the tables below readable

constexpr int kMaxGoalPoints = 1000;
constexpr std::int64_t kMaxWholeNumber = (std::int64_t{1} << 53) - 1;
constexpr double kMaxSeconds = 1e6;
constexpr double kMaxJointValue = 1e6;

Codec<Micrometres> distance() { return length_um({0, kMaxLengthMm}); }

/// Three coordinates, each of which may be null.
Codec<PartialPoint> partial_point() {
  Codec<std::optional<Micrometres>> coordinate;
  coordinate.read = [in_um = length_um(kCoordinate)](const Place& place,
                                                     std::optional<Micrometres>& result) {
    return place.value.is_null() || in_um.read(place, result.emplace());
  };
  return row<PartialPoint>(
      "a list [x, y, z] of three numbers of mm; null where a coordinate is of no interest",
      coordinate, {&PartialPoint::x, &PartialPoint::y, &PartialPoint::z});
}

/// Two opposite corners.
Codec<BoxUm> box() {
  const Codec<PointUm> corner = point_um(kCoordinate, "[x, y, z]");
  Codec<BoxUm> codec;
  codec.allowed = "a list of two opposite corners [[x, y, z], [x, y, z]] in mm";
  codec.read = [corner, allowed = codec.allowed](const Place& place, BoxUm& result) {
    if (!place.value.is_list() || place.value.size() != 2) return place.refuse(allowed);
    PointUm a;
    PointUm b;
    const bool has_first = corner.read(place.element(0), a);
    if (!corner.read(place.element(1), b) || !has_first) return false;
    result.low = {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
    result.high = {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
    return true;
  };
  return codec;
}

/// The name of a block, or null.
Codec<std::optional<std::string>> name_or_null() {
  const Codec<std::string> name = block_name();
  Codec<std::optional<std::string>> codec;
  codec.allowed = name.allowed + ", or null for no block";
  codec.read = [name, allowed = codec.allowed](const Place& place,
                                               std::optional<std::string>& result) {
    if (place.value.is_null()) return result.reset(), true;
    if (!place.value.is_text()) return place.refuse(allowed);
    return name.read(place, result.emplace());
  };
  return codec;
}

/// Simulated seconds, kept in ticks.
Codec<Tick> seconds() {
  return converted<Tick, double>(
      number({0, kMaxSeconds, true, "seconds"}),
      [](const double& seconds) { return static_cast<Tick>(std::llround(seconds * kTickHz)); },
      nullptr);
}

/// A tolerance, kept in whole microdegrees.
Codec<Microdegrees> angle() {
  constexpr double kHalfTurnDeg = 180;
  return converted<Microdegrees, double>(number({0, kHalfTurnDeg, false, "degrees"}), microdegrees,
                                         nullptr);
}

Codec<std::vector<std::string>> block_names() { return list(block_name(), 1, kMaxFileBlocks); }

// --- The members of each kind; overloaded by a null pointer of its type.

Members<BlockPlace> members_of(const BlockPlace*) {
  return {required("name", &BlockPlace::name, block_name()),
          optional("xyz_mm", &BlockPlace::point, partial_point()),
          optional("box_mm", &BlockPlace::box, box()),
          optional("at", &BlockPlace::at, block_name()),
          optional("offset_mm", &BlockPlace::offset, partial_point()),
          optional("mm", &BlockPlace::within_um, distance()),
          optional("yaw_deg", &BlockPlace::yaw_udeg, yaw()),
          optional("deg", &BlockPlace::within_udeg, angle()),
          optional("held", &BlockPlace::may_be_held, boolean())};
}

Members<Stacked> members_of(const Stacked*) {
  return {required("name", &Stacked::name, block_name()),
          required("on", &Stacked::on, block_name())};
}

Members<Sorted> members_of(const Sorted*) {
  return {optional("names", &Sorted::names, block_names()),
          required("by", &Sorted::by,
                   choice<SortKey>({{"size", SortKey::kSize},
                                    {"height", SortKey::kHeight},
                                    {"color", SortKey::kColor}})),
          required("along", &Sorted::along,
                   choice<SortAxis>({{"x", SortAxis::kX},
                                     {"-x", SortAxis::kMinusX},
                                     {"y", SortAxis::kY},
                                     {"-y", SortAxis::kMinusY}}))};
}

Members<Holding> members_of(const Holding*) {
  return {required("name", &Holding::name, name_or_null())};
}

Members<JointValue> members_of(const JointValue*) {
  return {required("label", &JointValue::label, motor_label()),
          optional("value", &JointValue::value, number({-kMaxJointValue, kMaxJointValue})),
          optional("count", &JointValue::count, integer<Counts>(INT32_MIN, INT32_MAX)),
          optional("within", &JointValue::within, number({0, kMaxJointValue}))};
}

Members<TipPlace> members_of(const TipPlace*) {
  return {required("xyz_mm", &TipPlace::point, partial_point()),
          optional("mm", &TipPlace::within_um, distance())};
}

Members<NoStall> members_of(const NoStall*) { return {}; }
Members<NoWarnings> members_of(const NoWarnings*) { return {}; }
Members<NoSoftHome> members_of(const NoSoftHome*) { return {}; }

Members<Untouched> members_of(const Untouched*) {
  return {required("names", &Untouched::names, block_names()),
          optional("mm", &Untouched::within_um, distance())};
}

Members<KeepOut> members_of(const KeepOut*) { return {required("box_mm", &KeepOut::box, box())}; }

Members<Order> members_of(const Order*) {
  constexpr std::size_t kMaxEvents = 1000;
  constexpr std::size_t kMaxEvent = 60;
  return {required("events", &Order::events, list(text(1, kMaxEvent), 1, kMaxEvents))};
}

Members<MaxSimTime> members_of(const MaxSimTime*) {
  return {required("value", &MaxSimTime::ticks, seconds())};
}

Members<MaxBytes> members_of(const MaxBytes*) {
  return {required("value", &MaxBytes::bytes, integer<std::uint64_t>(0, kMaxWholeNumber))};
}

Members<MaxTipPath> members_of(const MaxTipPath*) {
  return {required("mm", &MaxTipPath::length_um, distance())};
}

// --- Reading by kind.

/// A goal of a known kind as it is written.
template <class B>
struct Written {
  std::string kind;
  int points = 1;
  std::string hint;
  B body;
};

template <class B>
bool read_as(const Place& place, Goal& goal) {
  constexpr std::size_t kMaxHint = 1000;
  static const Members<Written<B>> members = [] {
    Members<Written<B>> all = {
        required("kind", &Written<B>::kind, text(1, kMaxHint)),
        optional("points", &Written<B>::points, whole_number(0, kMaxGoalPoints)),
        optional("hint", &Written<B>::hint, text(0, kMaxHint))};
    for (auto& own : spread(&Written<B>::body, members_of(static_cast<const B*>(nullptr))))
      all.push_back(std::move(own));
    return all;
  }();
  Written<B> written;
  const bool is_good = read_object(place, members, written);
  goal = {written.points, std::move(written.hint), std::move(written.body)};
  return is_good;
}

struct GoalKind {
  std::string name;
  bool (*read)(const Place&, Goal&);
};

/// In the order of goal::Condition.
const std::vector<GoalKind>& kinds() {
  static const std::vector<GoalKind> all = {{"block", read_as<BlockPlace>},
                                            {"stacked", read_as<Stacked>},
                                            {"sorted", read_as<Sorted>},
                                            {"holding", read_as<Holding>},
                                            {"joint", read_as<JointValue>},
                                            {"tip", read_as<TipPlace>},
                                            {"no_stall", read_as<NoStall>},
                                            {"no_warnings", read_as<NoWarnings>},
                                            {"no_soft_home", read_as<NoSoftHome>},
                                            {"untouched", read_as<Untouched>},
                                            {"keep_out", read_as<KeepOut>},
                                            {"order", read_as<Order>},
                                            {"max_sim_seconds", read_as<MaxSimTime>},
                                            {"max_bytes", read_as<MaxBytes>},
                                            {"max_tip_path", read_as<MaxTipPath>}};
  return all;
}

const std::vector<std::string>& goal_kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const GoalKind& kind : kinds()) all.push_back(kind.name);
    return all;
  }();
  return names;
}

/// Reads one goal of the kind that its member `kind` says.
bool read_goal(const Place& place, Goal& goal) {
  const std::string allowed = quoted_names(goal_kinds());
  if (!place.value.is_object()) return place.refuse("an object { \"kind\": ... }");
  const JsonValue kind = place.value.find("kind");
  if (!kind) {
    if (place.reading.keeps_error()) place.reading.keep_missing(place.value, "kind", allowed);
    return false;
  }
  for (const GoalKind& each : kinds())
    if (kind.is(each.name)) return each.read(place, goal);
  return Place{place.reading, kind}.refuse(allowed);
}

const Members<GoalList>& list_members() {
  constexpr std::size_t kMaxNotes = 4000;
  static const Members<GoalList> members = {
      optional("notes", &GoalList::notes, text(0, kMaxNotes)),
      required("goals", &GoalList::goals,
               list(Codec<Goal>{"an object { ... }", read_goal, nullptr}, 1, kMaxGoals)),
      optional("failed_program", &GoalList::failed_program_counts,
               choice<bool>({{"counts", true}}))};
  return members;
}

}  // namespace

const std::string& kind_of(const Goal& goal) {
  static_assert(std::variant_size_v<Condition> == 15, "each kind has a row in kinds()");
  return goal_kinds()[goal.body.index()];
}

FileReading<GoalList> read_goals(std::string_view text, const std::string& file,
                                 const Model* model) {
  return read_file(text, file, DataKind::kGoals, Unit::kMm, [&](Reading& reading) {
    return read_root(reading, list_members(),
                     [&](const GoalList& list, Reading&) { check_goals(list, model, reading); });
  });
}

GoalList load_goals(std::string_view text, const std::string& file, const Model& model) {
  return value_of(read_goals(text, file, &model));
}

std::string goals_summary(const GoalList& list) {
  int points = 0;
  for (const Goal& each : list.goals) points += each.points;
  std::string text =
      std::to_string(list.goals.size()) + " goals, " + std::to_string(points) + " points\n";
  if (!list.notes.empty()) text += list.notes + "\n";
  for (const Goal& each : list.goals) text += "  " + kind_of(each) + "\n";
  return text;
}

}  // namespace xr3
