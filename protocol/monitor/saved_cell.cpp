#include "protocol/monitor/saved_cell.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/motor.hpp"
#include "protocol/files/block.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/monitor/saved_faults.hpp"

namespace xr3 {
namespace {

using namespace data;  // NOLINT: keeps the tables below readable

constexpr Counts kMaxCounts = 1 << 30;
/// A distance greater than the reach of any arm that a robot file can describe; the camera's
/// arithmetic does not overflow.
constexpr Micrometres kFarthestUm = 2'000'000'000;
constexpr Micrometres kLargestUm = micrometres(kMaxLengthMm);
constexpr Microdegrees kHalfTurn = 180'000'000;
constexpr std::size_t kMaxHashLength = 200;

Codec<Counts> counts() { return integer<Counts>(-kMaxCounts, kMaxCounts); }

/// A list of exactly N values.
template <class V, std::size_t N>
Codec<std::array<V, N>> array_of(const Codec<V>& item) {
  const Codec<std::vector<V>> values = list(item, N, N);
  Codec<std::array<V, N>> codec;
  codec.allowed = values.allowed;
  codec.read = [values](const Place& place, std::array<V, N>& result) {
    std::vector<V> read;
    const bool is_good = values.read(place, read);
    if (is_good) std::copy(read.begin(), read.end(), result.begin());
    return is_good;
  };
  codec.write = [values](const std::array<V, N>& result) {
    return values.write({result.begin(), result.end()});
  };
  return codec;
}

/// `[x, y, z]` in whole micrometres.
Codec<PointUm> point(Micrometres low, Micrometres high) {
  auto codec = row<PointUm>(detail::list_text(3, 3), integer<Micrometres>(low, high),
                            {&PointUm::x, &PointUm::y, &PointUm::z});
  codec.allowed = "a list of three whole numbers of micrometres";
  return codec;
}

Codec<PointUm> place_um() { return point(-kFarthestUm, kFarthestUm); }

/// `[x, y, z]` of the view vector.
Codec<ViewVector> view() {
  auto codec = row<ViewVector>(detail::list_text(3, 3),
                               whole_number(-SetViewVector::kMax, SetViewVector::kMax),
                               {&ViewVector::x, &ViewVector::y, &ViewVector::z});
  codec.allowed = "a list of three whole numbers -9 to 9, not all 0";
  codec.read = [read = codec.read, allowed = codec.allowed](const Place& place, ViewVector& view) {
    if (!read(place, view)) return false;
    return view != ViewVector{0, 0, 0} || place.refuse(allowed);
  };
  return codec;
}

Members<MotorState> motor_members() {
  return {
      required("count", &MotorState::count, counts()),
      required("phase", &MotorState::phase, integer<std::int16_t>(0, kPhasePerCount - 1)),
      required("error", &MotorState::error, integer<std::int8_t>(INT8_MIN, INT8_MAX)),
      required("speed", &MotorState::speed, integer<std::uint8_t>(1, UINT8_MAX)),
      required("blocked", &MotorState::blocked,
               choice<Blocked>(
                   {{"no", Blocked::kNo}, {"limit", Blocked::kLimit}, {"block", Blocked::kBlock}})),
      required("switch_closed", &MotorState::switch_closed, boolean())};
}

Members<DisplaySettings> display_members() {
  return {required("on", &DisplaySettings::on, boolean()),
          required("view", &DisplaySettings::view, view()),
          required("period_half_s", &DisplaySettings::period_half_s,
                   whole_number(SetRefreshPeriod::kMin, SetRefreshPeriod::kMax)),
          required("erase", &DisplaySettings::erase, boolean()),
          required("status_option", &DisplaySettings::status_option,
                   whole_number(0, SelectStatus::kMax)),
          required("function_keys", &DisplaySettings::function_keys, boolean())};
}

/// Lines and ports; bit i stands for line or port i+1.
Members<InputOutput> io_members() {
  return {required("inputs", &InputOutput::inputs, integer<std::uint8_t>(0, UINT8_MAX)),
          required("outputs", &InputOutput::outputs, integer<std::uint8_t>(0, UINT8_MAX)),
          required("auxiliary", &InputOutput::auxiliary, integer<std::uint8_t>(0, 3))};
}

Members<Block> lying_block_members() {
  return {required("name", &Block::name, block_name()),
          required("size_um", &Block::size_um, point(1, kLargestUm)),
          required("centroid_um", &Block::centroid_um, place_um()),
          required("yaw_udeg", &Block::yaw_udeg, integer<Microdegrees>(1 - kHalfTurn, kHalfTurn)),
          required("color", &Block::color, block_color())};
}

Members<Held> held_members() {
  return {required("block", &Held::block, integer<std::uint32_t>(0, kMaxBlocks - 1)),
          required("quarter_turns", &Held::quarter_turns, whole_number(0, 3)),
          required("grasped_at", &Held::grasped_at, array_of<Counts, kMaxMotors>(counts()))};
}

Members<Rider> rider_members() {
  return {required("block", &Rider::block, integer<std::uint32_t>(0, kMaxBlocks - 1)),
          required("count", &Rider::count, counts()),
          required("centroid_um", &Rider::centroid_um, place_um()),
          required("yaw_udeg", &Rider::yaw_udeg, integer<Microdegrees>(1 - kHalfTurn, kHalfTurn))};
}

Members<TipPath> tip_path_members() {
  constexpr std::size_t kMax = TipPath::kMaxTipPoints;
  return {required("points", &TipPath::points, shared(list(place_um(), 0, kMax))),
          required("oldest", &TipPath::oldest, integer<std::size_t>(0, kMax - 1))};
}

Members<State> saved_state_members() {
  return {
      required("tick", &State::tick, integer<Tick>(0, monitor::kMaxInteger)),
      required("motors", &State::motors, array_of<MotorState, kMaxMotors>(object(motor_members()))),
      required("stall", &State::stall,
               choice<Stall>({{"no", Stall::kNo},
                              {"protected_region", Stall::kProtectedRegion},
                              {"work_surface", Stall::kWorkSurface}})),
      required("below_surface", &State::below_surface, boolean()),
      required("enabled", &State::enabled, boolean()),
      required("display", &State::display, object(display_members())),
      required("io", &State::io, object(io_members())),
      required("blocks", &State::blocks,
               shared(list(object(lying_block_members()), 0, kMaxBlocks))),
      optional("held", &State::held, object(held_members())),
      optional("riders", &State::riders, list(object(rider_members()), 0, kMaxBlocks)),
      required("jaws_warned", &State::jaws_warned, boolean()),
      required("tip_path", &State::tip_path, object(tip_path_members())),
      optional("faults", &State::faults, saved_faults())};
}

/// A workcell in the form of its file; the rules of workcell files apply, with higher bounds.
Codec<Workcell> workcell_file() {
  Codec<Workcell> codec;
  codec.allowed = "a workcell in the form of its file";
  codec.read = [](const Place& place, Workcell& workcell) {
    Reading reading(place.value, Unit::kOfDocument);
    std::optional<Workcell> read = read_workcell(reading, nullptr, 0, WorkcellBounds::kSaved);
    place.reading.adopt(reading);
    if (!read) return false;
    workcell = *std::move(read);
    return true;
  };
  codec.write = workcell_to_json;
  return codec;
}

const Members<SavedCell>& saved_cell_members() {
  static const Members<SavedCell> members = {
      required("robot_hash", &SavedCell::robot_hash, text(0, kMaxHashLength)),
      required("workcell", &SavedCell::workcell, workcell_file()),
      required("state", &SavedCell::state, object(saved_state_members()))};
  return members;
}

// --- Rules that concern several members.

void check_held(const State& state, Reading& reading) {
  if (!state.held || !reading.is_sound("/state/held/block") || !reading.is_sound("/state/blocks"))
    return;
  if (state.held->block < state.blocks.size()) return;
  reading.refuse("/state/held/block", std::to_string(state.held->block),
                 "the index of one of " + std::to_string(state.blocks.size()) + " blocks");
}

/// Requires the indices of blocks that are not held, in increasing order.
void check_riders(const State& state, Reading& reading) {
  if (!reading.is_sound("/state/riders") || !reading.is_sound("/state/blocks")) return;
  std::size_t next = 0;
  for (std::size_t i = 0; i < state.riders.size(); ++i) {
    const std::uint32_t block = state.riders[i].block;
    const bool is_held = state.held && state.held->block == block;
    if (block >= next && block < state.blocks.size() && !is_held) {
      next = block + std::size_t{1};
      continue;
    }
    reading.refuse(child_pointer("/state/riders", i) + "/block", std::to_string(block),
                   "the indices of blocks that are not held, in increasing order");
  }
}

/// Requires a valid index of the oldest point. Until a path is full, that is the first.
void check_path(const TipPath& path, Reading& reading) {
  if (path.oldest == 0 || path.points.size() == TipPath::kMaxTipPoints) return;
  if (!reading.is_sound("/state/tip_path")) return;
  reading.refuse(
      "/state/tip_path/oldest", std::to_string(path.oldest),
      "0 if the path has fewer than " + std::to_string(TipPath::kMaxTipPoints) + " points");
}

}  // namespace

Json saved_cell_to_json(const SavedCell& saved) {
  return write_object(saved, saved_cell_members());
}

Json saved_state_to_json(const State& state) {
  static const Members<State> members = saved_state_members();
  return write_object(state, members);
}

std::optional<SavedCell> read_saved_cell(Reading& reading) {
  return read_root(reading, saved_cell_members(), [](const SavedCell& saved, Reading& into) {
    data::check_names(saved.state.blocks.all(), "/state/blocks", "block", into);
    check_held(saved.state, into);
    check_riders(saved.state, into);
    check_path(saved.state.tip_path, into);
    check_saved_faults(saved.state.faults, "/state/faults", into);
  });
}

FileReading<SavedCell> read_saved_cell(const Json& json) {
  const std::string text = json.dump();
  const JsonDocument document(text);
  Reading reading(document.root(), Unit::kMm);
  std::optional<SavedCell> saved = read_saved_cell(reading);
  return {std::move(saved), reading.take_findings()};
}

// Many blocks are refused by their number: writing them takes longer than other lines may wait.
bool monitor::fits_a_request(const SavedCell& saved) {
  constexpr std::size_t kCall = 1024;      // includes an escaped id of 64 bytes and the cell's name
  constexpr std::size_t kLeastBlock = 40;  // the JSON of a block is longer
  const std::size_t blocks = saved.workcell.blocks.size() + saved.state.blocks.size();
  if (blocks > kMaxMessageBytes / kLeastBlock) return false;
  return saved_cell_to_json(saved).dump().size() <= kMaxMessageBytes - kCall;
}

}  // namespace xr3
