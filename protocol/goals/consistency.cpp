// The rules of goals files; declared in file.hpp.
#include <algorithm>
#include <string>
#include <string_view>

#include "protocol/goals/file.hpp"

namespace xr3 {
namespace {

using data::Reading;

/// Checks one goal; overloaded for its kinds.
class GoalChecker {
 public:
  GoalChecker(const Model* model, std::string pointer, Reading& reading)
      : model_(model), pointer_(std::move(pointer)), reading_(reading) {}

  void operator()(const goal::BlockPlace& block) const {
    require_block("name", block.name);
    if (!block.at.empty()) require_block("at", block.at);
    const int places =
        int{block.point.has_value()} + int{block.box.has_value()} + int{!block.at.empty()};
    if (places > 1) refuse("", "several places", "one of xyz_mm, box_mm and at");
    if (places == 0 && !block.yaw_udeg && !block.may_be_held)
      refuse("", "no place", "one of xyz_mm, box_mm and at, or yaw_deg");
    if (block.at == block.name) refuse("/at", quoted(block.at), "another block");
    if (block.at.empty() && block.offset != PartialPoint{})
      refuse("/offset_mm", "an offset", "no offset_mm without at");
  }
  void operator()(const goal::Stacked& stacked) const {
    require_block("name", stacked.name);
    require_block("on", stacked.on);
    if (stacked.name == stacked.on) refuse("/on", quoted(stacked.on), "another block");
  }
  void operator()(const goal::Sorted& sorted) const { require_blocks(sorted.names); }
  void operator()(const goal::Holding& holding) const {
    if (holding.name) require_block("name", *holding.name);
  }
  void operator()(const goal::JointValue& joint) const {
    if (model_ != nullptr && model_->index_of(joint.label) < 0)
      refuse("/label", quoted({&joint.label, 1}), "one of " + model_->labels());
    if (joint.value.has_value() == joint.count.has_value())
      refuse("", joint.value ? "value and count" : "neither value nor count",
             "value in degrees or mm, or count");
  }
  void operator()(const goal::TipPlace& tip) const {
    if (tip.point == PartialPoint{}) refuse("/xyz_mm", "no coordinate", "at least one number");
  }
  void operator()(const goal::Untouched& untouched) const { require_blocks(untouched.names); }
  void operator()(const goal::Order& order) const {
    for (std::size_t i = 0; i < order.events.size(); ++i)
      check_happening("/events/" + std::to_string(i), order.events[i]);
  }
  template <class Other>
  void operator()(const Other&) const {}

 private:
  static std::string quoted(std::string_view name) { return "\"" + std::string(name) + "\""; }

  void refuse(const std::string& member, std::string found, std::string allowed) const {
    reading_.refuse(pointer_ + member, std::move(found), std::move(allowed));
  }
  void require_block(const std::string& member, const std::string& name) const {
    require_block_at("/" + member, name);
  }
  void require_blocks(const std::vector<std::string>& names) const {
    for (std::size_t i = 0; i < names.size(); ++i)
      require_block_at("/names/" + std::to_string(i), names[i]);
  }
  void require_block_at(const std::string& place, const std::string& name) const {
    if (model_ == nullptr) return;
    const auto& blocks = model_->workcell().blocks;
    const bool is_known = std::any_of(blocks.begin(), blocks.end(),
                                      [&](const Block& block) { return block.name == name; });
    if (!is_known) refuse(place, quoted(name), names_of_blocks());
  }
  std::string names_of_blocks() const {
    constexpr std::size_t kMaxShown = 10;
    const auto& blocks = model_->workcell().blocks;
    if (blocks.empty()) return "no name: the workcell has no blocks";
    std::string text = "a block of the workcell: ";
    for (std::size_t i = 0; i < blocks.size() && i < kMaxShown; ++i)
      text += (i == 0 ? "" : ", ") + blocks[i].name;
    return blocks.size() > kMaxShown ? text + ", ..." : text;
  }
  /// "grasped NAME" or "released NAME".
  void check_happening(const std::string& place, const std::string& event) const {
    const std::size_t space = event.find(' ');
    const std::string kind = event.substr(0, space);
    if (space == std::string::npos || (kind != "grasped" && kind != "released"))
      return refuse(place, quoted(event), "\"grasped NAME\" or \"released NAME\", NAME of a block");
    require_block_at(place, event.substr(space + 1));
  }

  const Model* model_;
  std::string pointer_;
  Reading& reading_;
};

}  // namespace

void check_goals(const GoalList& list, const Model* model, Reading& reading) {
  for (std::size_t i = 0; i < list.goals.size(); ++i) {
    const std::string pointer = "/goals/" + std::to_string(i);
    if (reading.is_sound(pointer))
      std::visit(GoalChecker(model, pointer, reading), list.goals[i].body);
  }
}

}  // namespace xr3
