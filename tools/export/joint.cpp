#include "tools/export/joint.hpp"

#include "tools/export/numbers.hpp"

namespace xr3 {
namespace {

constexpr double kEndlessDeg = 720;  ///< a joint with a longer range is exported without limits

/// The number of links before this one that have its motor.
int twins_before(const std::vector<SceneLink>& links, std::size_t link) {
  int twins = 0;
  for (std::size_t i = 0; i < link; ++i) twins += links[i].motor == links[link].motor ? 1 : 0;
  return twins;
}

}  // namespace

std::optional<ExportedJoint> joint_of(const Model& model, const std::vector<SceneLink>& links,
                                      std::size_t index) {
  const SceneLink& link = links[index];
  if (link.is_fixed()) return std::nullopt;
  const Drive& drive = model.motor(link.motor).drive;
  const bool turns = link.motion == LinkMotion::kTurns;
  const double unit = link.ratio * (turns ? kPi / 180 : kMetresPerMm);
  const std::string label(1, drive.label);
  const int twins = twins_before(links, index);
  return ExportedJoint{twins > 0 ? label + "_" + std::to_string(twins + 1) : label,
                       twins > 0 ? label : "",
                       turns && drive.max - drive.min > kEndlessDeg,
                       unit * drive.min,
                       unit * drive.max,
                       unit * drive.home,
                       unit * drive.precision * drive.speed_counts_per_s};
}

}  // namespace xr3
