#include "core/model.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace xr3 {
namespace {

constexpr double kCountTolerance = 1e-6;

MotorModel motor_model(const Drive& drive, Profile profile) {
  const CountRange range = count_limits(drive);
  const Counts period =
      profile == Profile::kMark3 ? drive.microswitch.period.value_or(Counts{0}) : 0;
  return {drive, range.low, range.high, closed_range(drive.microswitch, profile), period};
}

CarouselModel carousel_model(const Carousel& carousel) {
  return {micrometres(carousel.x_mm), micrometres(carousel.y_mm), micrometres(carousel.radius_mm),
          micrometres(carousel.height_mm), carousel.drive.precision * carousel.drive.direction};
}

}  // namespace

CountRange count_limits(const Drive& drive) {
  const double low = std::ceil((drive.min - drive.home) / drive.precision - kCountTolerance);
  const double high = std::floor((drive.max - drive.home) / drive.precision + kCountTolerance);
  const auto first = static_cast<Counts>(low);
  const auto last = static_cast<Counts>(high);
  return drive.direction > 0 ? CountRange{first, last} : CountRange{-last, -first};
}

CountRange closed_range(const Microswitch& microswitch, Profile profile) {
  const Counts at = microswitch.position;
  if (microswitch.width) return {at - *microswitch.width / 2, at + *microswitch.width / 2};
  using Limits = std::numeric_limits<Counts>;
  const bool has_end = profile == Profile::kMark3;
  if (at < 0) return {has_end ? at - kMark3SwitchRange : Limits::min(), at};
  return {at, has_end ? at + kMark3SwitchRange : Limits::max()};
}

Model::Model(Robot robot, Workcell workcell, Profile profile)
    : robot_(std::move(robot)),
      workcell_(std::move(workcell)),
      profile_(profile),
      joint_count_(static_cast<int>(robot_.joints.size())),
      motor_count_(joint_count_ + (robot_.carousel ? 2 : 1)) {
  for (const Joint& joint : robot_.joints) motors_.push_back(motor_model(joint.drive, profile));
  motors_.push_back(motor_model(robot_.tool.drive, profile));
  if (robot_.carousel) {
    motors_.push_back(motor_model(robot_.carousel->drive, profile));
    carousel_ = carousel_model(*robot_.carousel);
  }
  assert(motor_count() <= kMaxMotors);
  find_labels();
  find_gains();
  fill_tables();
  region_radius_um_ = micrometres(robot_.protected_region.radius_mm);
  region_height_um_ = micrometres(robot_.protected_region.height_mm);
}

// A coupling relates joint variables. Between counts, the directions of both motors enter, too.
void Model::find_gains() {
  for (int i = 0; i < motor_count(); ++i)
    gain_[static_cast<std::size_t>(i)][static_cast<std::size_t>(i)] = 1;
  for (const Coupling& c : robot_.couplings) {
    const int sign = c.sign * motor(c.joint).drive.direction * motor(c.coupled).drive.direction;
    auto& gain = gain_[static_cast<std::size_t>(c.coupled)][static_cast<std::size_t>(c.joint)];
    gain = static_cast<std::int8_t>(gain + sign);
  }
  for (int turning = 0; turning < motor_count(); ++turning) {
    auto& driven = driven_[static_cast<std::size_t>(turning)];
    driven.push_back({static_cast<std::uint8_t>(turning), 1});
    for (int joint = 0; joint < joint_count(); ++joint) {
      if (joint == turning || gain(joint, turning) == 0) continue;
      driven.push_back(
          {static_cast<std::uint8_t>(joint), static_cast<std::int8_t>(gain(joint, turning))});
    }
  }
}

void Model::fill_tables() {
  for (int k = 0; k < joint_count(); ++k) {
    const Joint& joint = robot_.joints[static_cast<std::size_t>(k)];
    const bool turns = joint.is_revolute();
    const double step = turns ? joint.drive.precision * joint.drive.direction : 0.0;
    const Counts low = turns ? motor(k).low : 0;
    const Counts high = turns ? motor(k).high : 0;
    thetas_.emplace_back(joint.dh.theta_deg, step, low, high);
    twists_.push_back(sin_cos_deg(joint.dh.alpha_deg));
  }
  if (const std::optional<DhRow>& mount = robot_.mount) {
    mount_angles_ = MountAngles{sin_cos_deg(mount->theta_deg), sin_cos_deg(mount->alpha_deg)};
  }
  while (slide_count_ < joint_count() &&
         !robot_.joints[static_cast<std::size_t>(slide_count_)].is_revolute()) {
    ++slide_count_;
  }
}

void Model::find_labels() {
  indices_.fill(-1);
  for (int index = 0; index < motor_count(); ++index)
    indices_.at(static_cast<std::size_t>(motor(index).drive.label - 'A')) =
        static_cast<std::int8_t>(index);
}

std::string Model::labels() const {
  std::string letters;
  for (char label = 'A'; label <= kLastLabel; ++label)
    if (index_of(label) >= 0) letters += label;
  return letters;
}

std::string Model::name(int index) const {
  if (index == tool_index()) return "tool";
  if (index == carousel_index()) return robot_.carousel->name;
  return robot_.joints[static_cast<std::size_t>(index)].name;
}

bool Model::is_length(int index) const {
  if (index == tool_index()) return robot_.tool.kind == ToolKind::kParallel;
  if (index == carousel_index()) return false;
  return !robot_.joints[static_cast<std::size_t>(index)].is_revolute();
}

double Model::variable(int index, Counts position) const {
  const Drive& drive = motor(index).drive;
  return drive.home + drive.precision * drive.direction * static_cast<double>(position);
}

SinCos Model::theta(int joint, Counts position) const {
  return thetas_[static_cast<std::size_t>(joint)].at(position);
}

double Model::link_offset_mm(int joint, Counts position) const {
  const Joint& link = robot_.joints[static_cast<std::size_t>(joint)];
  return link.variable == JointVariable::kD ? variable(joint, position) : link.dh.d_mm;
}

}  // namespace xr3
