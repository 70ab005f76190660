// The questions of the workcell dialogue about blocks. Answers go to a separate block, which is
// checked against the robot, the workspace and all other blocks before it is stored.
#include <algorithm>
#include <utility>

#include "protocol/files/consistency.hpp"
#include "protocol/files/workcell.hpp"
#include "tools/workcell_editor/dialogue.hpp"

namespace xr3 {
namespace {

using dialogue::kAnyPlace;
using dialogue::kAnySize;

constexpr std::size_t kMaxBlockName = 40;
constexpr int kLastColor = 15;

constexpr const char* kColorHelp =
    "0 black, 1 blue, 2 green, 3 cyan, 4 red, 5 magenta, 6 brown, 7 light grey, 8 grey,\n"
    "9 to 14 the bright forms of 1 to 6 (14 is yellow), 15 white.";

}  // namespace

WorkcellDialogue::Step WorkcellDialogue::name_of_block_step() {
  const auto is_taken = [this](const std::string& name) -> std::string {
    for (std::size_t i = 0; i < workcell_.blocks.size(); ++i) {
      if (i != block_index_ && workcell_.blocks[i].name == name)
        return "Another block has this name.";
    }
    return "";
  };
  return [this, is_taken] {
    return dialogue::text_question("Block's name", 1, kMaxBlockName, block_.name,
                                   "Its name in messages; must be unique.", is_taken);
  };
}

WorkcellDialogue::Steps WorkcellDialogue::size_steps() {
  const Workspace& space = workcell_.workspace;
  const Micrometres jaws = micrometres(widest_opening_mm(arm_.robot));
  return {length_step("Length", {1, space.x_um}, kAnySize, block_.size_um.x,
                      "Along its own x. At 1.5 times the width its angle can be seen."),
          length_step("Width", {1, jaws}, kAnySize, block_.size_um.y,
                      "Along its own y. The jaws must open wider than this."),
          [this] {
            say(dialogue::jaws_note(block_, arm_.robot));
            const Micrometres room = workcell_.workspace.z_um - workcell_.work_surface_um;
            return dialogue::length_question("Height", {1, room}, kAnySize, block_.size_um.z,
                                             "Upwards; the jaws hold it in the middle.");
          }};
}

WorkcellDialogue::Steps WorkcellDialogue::place_steps() {
  const Workspace& space = workcell_.workspace;
  return {length_step("x of its middle", {0, space.x_um}, kAnyPlace, block_.centroid_um.x,
                      "Distance in front of the robot's base."),
          length_step("y of its middle", {-space.y_um, space.y_um}, kAnyPlace, block_.centroid_um.y,
                      "Distance to the left of the robot's base, as the robot faces.")};
}

WorkcellDialogue::Step WorkcellDialogue::yaw_step() {
  return [this] {
    return dialogue::yaw_question("Orientation", block_.yaw_udeg,
                                  "Its rotation about the vertical, from x towards y.");
  };
}

/// Asks for the height; the default is on the table or on the blocks below.
WorkcellDialogue::Step WorkcellDialogue::height_step() {
  return [this] {
    block_.centroid_um.z = dialogue::resting_z(workcell_, block_index_, block_);
    const dialogue::Lengths sensible{workcell_.work_surface_um, workcell_.workspace.z_um};
    return dialogue::length_question("z of its middle", sensible, kAnyPlace, block_.centroid_um.z,
                                     "The default is on the table, or on the block below it.");
  };
}

WorkcellDialogue::Step WorkcellDialogue::color_step() {
  return [this] {
    return dialogue::whole_question("Colour", 0, kLastColor, block_.color, kColorHelp);
  };
}

void WorkcellDialogue::edit_block(Steps steps) {
  block_steps_ = std::move(steps);
  ask_block();
}

void WorkcellDialogue::ask_block() {
  ask(block_steps_, [this] { judge_block(); });
}

void WorkcellDialogue::add() {
  if (workcell_.blocks.size() >= kMaxFileBlocks)
    return say("The workcell has the maximum number of blocks.\n");
  block_index_ = workcell_.blocks.size();
  block_ = dialogue::proposed_block(workcell_, arm_);
  change();
}

void WorkcellDialogue::change() {
  edit_block(joined({{name_of_block_step()},
                     size_steps(),
                     place_steps(),
                     {yaw_step(), height_step(), color_step()}}));
}

void WorkcellDialogue::remove() {
  ask_yes_no("Remove \"" + block_.name + "\"?", true, "yes: remove it. no: keep it.",
             [this](bool removes) {
               if (!removes) return;
               std::vector<Block>& blocks = workcell_.blocks.edit();
               blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(block_index_));
               say("Removed. Other blocks may have other letters now.\n");
             });
}

/// Checks the block. After errors the items are asked again; a block with mere warnings may be
/// kept.
void WorkcellDialogue::judge_block() {
  Workcell candidate = workcell_;
  std::vector<Block>& blocks = candidate.blocks.edit();
  blocks.resize(std::max(blocks.size(), block_index_ + 1));
  blocks[block_index_] = block_;
  const Findings findings = dialogue::check_block(workcell_, block_index_, block_, arm_);
  if (findings.empty()) return keep_block();
  say(dialogue::notes(candidate, findings));
  if (has_errors(findings)) {
    say("Not valid. Please enter the items again:\n");
    return ask_block();
  }
  ask_yes_no("Keep it anyway?", false, "yes: keep it. no: the items are asked again.",
             [this](bool keeps) { keeps ? keep_block() : ask_block(); });
}

void WorkcellDialogue::keep_block() {
  const bool is_added = block_index_ == workcell_.blocks.size();
  std::vector<Block>& blocks = workcell_.blocks.edit();
  if (is_added) blocks.emplace_back();
  blocks[block_index_] = block_;
  say(std::string(is_added ? "Added" : "Changed") + ": " + block_letters(blocks)[block_index_] +
      " \"" + block_.name + "\" at (" + dialogue::mm_text(block_.centroid_um.x) + ", " +
      dialogue::mm_text(block_.centroid_um.y) + ", " + dialogue::mm_text(block_.centroid_um.z) +
      ").\n");
  if (is_making_) offer_block();
}

}  // namespace xr3
