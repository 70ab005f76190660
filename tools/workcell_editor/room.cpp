// The questions of the workcell dialogue about everything except blocks: name, workspace, work
// surface and camera (paper, Section III-B). Answers go to a draft, which replaces the workcell if
// it has no errors.
#include <utility>

#include "protocol/files/workcell.hpp"
#include "tools/workcell_editor/dialogue.hpp"

namespace xr3 {
namespace {

using dialogue::kAnyPlace;
using dialogue::kAnySize;
using dialogue::Lengths;

constexpr std::size_t kMaxWorkcellName = 80;
constexpr std::size_t kMaxNotesHeight = 4000;

}  // namespace

// A new workcell: workspace and surface, blocks, camera.

void WorkcellDialogue::ask_all() {
  is_making_ = true;
  edit_room(joined({name_steps(), workspace_steps(), surface_steps()}), [this] { offer_block(); });
}

void WorkcellDialogue::offer_block() {
  ask_yes_no(workcell_.blocks.empty() ? "A block?" : "Another block?", true,
             "Blocks can be added, changed and removed later as well.",
             [this](bool is_wanted) { is_wanted ? add() : camera(); });
}

// Name, workspace and surface.

/// Asks questions about a draft of the workcell; after valid answers does `then`.
void WorkcellDialogue::edit_room(Steps steps, std::function<void()> then) {
  draft_ = workcell_;
  room_steps_ = std::move(steps);
  room_then_ = std::move(then);
  ask_room();
}

void WorkcellDialogue::ask_room() {
  ask(room_steps_, [this] { keep_room(); });
}

void WorkcellDialogue::keep_room() {
  const Findings findings = dialogue::check(draft_, arm_);
  if (has_errors(findings)) {
    say(dialogue::notes(draft_, findings) + "Not valid. Please enter the items again:\n");
    return ask_room();
  }
  const std::string before = dialogue::notes(workcell_, dialogue::check(workcell_, arm_));
  const std::string notes = dialogue::notes(draft_, findings);
  workcell_ = draft_;
  if (notes != before) say(notes);
  then_ = std::exchange(room_then_, nullptr);
}

WorkcellDialogue::Step WorkcellDialogue::length_step(const std::string& prompt, Lengths sensible,
                                                     Lengths possible, Micrometres& value,
                                                     const std::string& help) {
  return [=, &value] { return dialogue::length_question(prompt, sensible, possible, value, help); };
}

WorkcellDialogue::Steps WorkcellDialogue::name_steps() {
  return {[this] {
            return dialogue::text_question("Name", 1, kMaxWorkcellName, draft_.name,
                                           "The name of this workcell.", {});
          },
          [this] {
            return dialogue::text_question("Notes", 0, kMaxNotesHeight, draft_.notes,
                                           "Any remarks; - for none.", {});
          }};
}

WorkcellDialogue::Steps WorkcellDialogue::workspace_steps() {
  Workspace& space = draft_.workspace;
  return {length_step("Workspace X, to the front", kAnySize, kAnySize, space.x_um,
                      "It reaches from the base, x = 0, to x = X."),
          length_step("Workspace Y, to either side", kAnySize, kAnySize, space.y_um,
                      "It reaches from y = -Y, right of the base, to y = Y, left of it."),
          length_step("Workspace Z, upwards", kAnySize, kAnySize, space.z_um,
                      "It reaches from the foot of the base, z = 0, to z = Z.")};
}

WorkcellDialogue::Steps WorkcellDialogue::surface_steps() {
  return {[this] {
            const Micrometres top = draft_.workspace.z_um;
            return dialogue::length_question("Work surface, z", {0, top}, {kAnyPlace.min, top - 1},
                                             draft_.work_surface_um,
                                             "Height of the table above the foot of the base.");
          },
          [this] {
            return dialogue::yes_no_question(
                "Stall under the surface?", draft_.surface_stalls,
                "yes: the robot stalls when its tip goes below the table. no: only a warning.");
          }};
}

// The camera.

void WorkcellDialogue::camera() {
  draft_ = workcell_;
  ask_yes_no("A camera?", draft_.camera.has_value() || is_making_,
             "A fixed camera that looks straight down.",
             [this](bool is_wanted) { edit_camera(is_wanted); });
}

void WorkcellDialogue::edit_camera(bool is_wanted) {
  room_then_ = nullptr;
  if (std::exchange(is_making_, false)) room_then_ = [this] { view(); };
  if (!is_wanted) {
    draft_.camera.reset();
    return keep_room();
  }
  if (!draft_.camera) draft_.camera = dialogue::proposed_camera(draft_);
  Camera& camera = *draft_.camera;
  const Workspace& space = draft_.workspace;
  const Lengths above{draft_.work_surface_um + 1, kAnyPlace.max};
  const std::string field = "Of the work surface; its middle is under the camera.";
  room_steps_ = {
      length_step("Camera x", {0, space.x_um}, kAnyPlace, camera.location_um.x,
                  "Its position; it looks straight down."),
      length_step("Camera y", {-space.y_um, space.y_um}, kAnyPlace, camera.location_um.y,
                  "Its position; it looks straight down."),
      length_step("Camera z", above, above, camera.location_um.z,
                  "Above the work surface; in perspective above every block."),
      length_step("Field along x", {1, space.x_um}, kAnySize, camera.field_x_um, field),
      length_step("Field along y", {1, 2 * space.y_um}, kAnySize, camera.field_y_um, field),
      [&camera] {
        return dialogue::whole_question("Pixels along x", 1, kMaxFilePixels, camera.pixels_x,
                                        "Columns of the image; 2 mm per pixel is fine.");
      },
      [&camera] {
        return dialogue::whole_question("Pixels along y", 1, kMaxFilePixels, camera.pixels_y,
                                        "Rows of the image.");
      },
      [&camera] {
        return dialogue::projection_question(
            "Projection", camera.projection,
            "orthographic: straight down everywhere. perspective: as seen from the camera.");
      }};
  ask_room();
}

}  // namespace xr3
