// The call `inverse`.
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/inverse/tool_place.hpp"
#include "protocol/monitor/request_error.hpp"
#include "protocol/text/table.hpp"
#include "service/answer.hpp"
#include "service/calls.hpp"

namespace xr3::service {
namespace {

constexpr double kHundredths = 100;

double rounded_up(double value) { return std::ceil(value * kHundredths) / kHundredths; }

/// The motor counts from which the tool moves, or a label of `near` that the robot does not have.
std::variant<Positions, char> start_of(const Cell& cell, const std::map<char, Counts>& near) {
  Positions start{};
  for (int i = 0; i < cell.model().motor_count(); ++i)
    start[static_cast<std::size_t>(i)] = cell.state().motor(i).count;
  for (const auto& [label, counts] : near) {
    const int index = cell.model().index_of(label);
    if (index < 0) return label;
    start[static_cast<std::size_t>(index)] = counts;
  }
  return start;
}

std::string_view name_of(Obstacle obstacle) {
  switch (obstacle) {
    case Obstacle::kTooFar: return "too_far";
    case Obstacle::kTooNear: return "too_near";
    case Obstacle::kDirection: return "direction";
    case Obstacle::kLimit: return "limit";
    case Obstacle::kProtectedRegion: return "protected_region";
    case Obstacle::kWorkSurface: return "work_surface";
    case Obstacle::kNotFound: return "not_found";
    case Obstacle::kNoBranch: break;
  }
  return "no_branch";
}

std::string text_of(const Model& model, const Unreachable& no) {
  const bool is_angle = no.obstacle == Obstacle::kDirection ||
                        (no.obstacle == Obstacle::kLimit && !model.is_length(no.joint));
  const std::string amount = plain_number(rounded_up(no.amount), 1) + (is_angle ? "°" : " mm");
  switch (no.obstacle) {
    case Obstacle::kTooFar: return amount + " too far";
    case Obstacle::kTooNear: return amount + " too near to the arm";
    case Obstacle::kDirection: return "the hand cannot point there: it is " + amount + " off";
    case Obstacle::kLimit:
      return "the " + model.name(no.joint) + " would pass its limit by " + amount;
    case Obstacle::kProtectedRegion: return "inside the protected region";
    case Obstacle::kWorkSurface: return amount + " below the table";
    case Obstacle::kNotFound:
      return "no way there was found from here: the nearest try is " + amount + " off";
    case Obstacle::kNoBranch: break;
  }
  return "the arm cannot be there with this branch";
}

Json place_json(const Model& model, const ReachedPlace& place) {
  Json counts = Json::object();
  for (int i = 0; i < model.motor_count(); ++i)
    counts[std::string(1, model.motor(i).drive.label)] = place.counts[static_cast<std::size_t>(i)];
  const Eigen::Vector3d& tip = place.tip_mm;
  return {{"counts", std::move(counts)},
          {"branch", place.branch},
          {"xyz_mm", Json::array({tip.x(), tip.y(), tip.z()})}};
}

monitor::Message unreachable(const monitor::RequestId& id, const Model& model,
                             const Unreachable& no) {
  monitor::RequestError error{id, "unreachable", text_of(model, no), "", {}, {}};
  error.more = {
      {"cause", name_of(no.obstacle)}, {"amount", rounded_up(no.amount)}, {"nearest", nullptr}};
  if (no.obstacle == Obstacle::kLimit)
    error.more["joint"] = std::string(1, model.motor(no.joint).drive.label);
  if (no.nearest) error.more["nearest"] = place_json(model, *no.nearest);
  return monitor::result(error);
}

}  // namespace

monitor::Message carry_out(const CellCall& of, const monitor::FindCounts& find) {
  Cell& cell = of.cell;
  cell.catch_up(of.now);
  const Model& model = cell.model();
  const auto start = start_of(cell, find.near);
  if (const char* label = std::get_if<char>(&start))
    return refused(of.id(), {"no_such_joint", "this robot has no joint " + std::string(1, *label),
                             "its labels are " + model.labels()});
  const WantedPlace wanted{{mm(find.tip_um.x), mm(find.tip_um.y), mm(find.tip_um.z)},
                           find.pitch_deg,
                           find.roll_deg,
                           find.branch};
  const auto found = reach_place(model, std::get<Positions>(start), wanted);
  if (const auto* no = std::get_if<Unreachable>(&found)) return unreachable(of.id(), model, *no);
  Json value = value_now(cell);
  value.update(place_json(model, std::get<ReachedPlace>(found)));
  return monitor::result(of.id(), value);
}

}  // namespace xr3::service
