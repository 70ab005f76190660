// The call `inverse`: the motor counts for a place of the tool.
#include <utility>

#include "protocol/files/block.hpp"
#include "protocol/monitor/calls/form.hpp"

namespace xr3::monitor {
namespace {

constexpr std::int64_t kMaxCounts = 1'000'000;
constexpr double kMaxAngle = 360;

/// Counts by label: a member for each motor.
std::map<char, Counts> read_near(ArgsReader& args) {
  std::map<char, Counts> near;
  const JsonValue object =
      args.object("near", Presence::kOptional,
                  "an object of motor counts by label, such as {\"F\":0,\"E\":50}");
  if (!object) return near;
  ArgsReader members(object, args.pointer_to("near"), args.findings());
  for (char label = 'A'; label <= 'H'; ++label) {
    const auto counts =
        members.integer(std::string(1, label), -kMaxCounts, kMaxCounts, Presence::kOptional);
    if (counts) near[label] = static_cast<Counts>(*counts);
  }
  members.refuse_others();
  return near;
}

CallValue read_inverse(ArgsReader& args) {
  FindCounts find;
  find.tip_um = args.coded("xyz_mm", data::block_centroid()).value_or(PointUm{});
  find.pitch_deg = args.number("pitch_deg", -kMaxAngle, kMaxAngle, Presence::kOptional);
  find.roll_deg = args.number("roll_deg", -kMaxAngle, kMaxAngle, Presence::kOptional);
  find.branch = args.coded("branch", data::text(1, 64), Presence::kOptional).value_or("");
  find.near = read_near(args);
  return find;
}

constexpr CallForm kInverseCalls[] = {
    {"inverse", "Finds the motor counts that bring the tool to a place.", read_inverse},
};

}  // namespace

CallForms inverse_calls() { return kInverseCalls; }

}  // namespace xr3::monitor
