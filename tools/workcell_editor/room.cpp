// The questions of the workcell dialogue about everything except blocks: name, workspace, work
// surface and camera (paper, Section III-B). Answers go to a draft, which replaces the workcell if
// it has no errors.
#include <utility>

#include "tools/workcell_editor/dialogue.hpp"

namespace xr3 {
namespace {

using dialogue::kAnyPlace;
using dialogue::kAnySize;
using dialogue::Lengths;

constexpr std::size_t kMaxWorkcellName = 80;
constexpr std::size_t kMaxNotesHeight = 4000;
constexpr int kMaxCameraPixels = 2048;

}  // namespace

// A new workcell: workspace and surface, blocks, camera.

void WorkcellDialogue::ask_all() {
  is_making_ = true;
  draft_ = workcell_;
  std::deque<Step> steps = name_steps();
  for (Step& step : workspace_steps()) steps.push_back(std::move(step));
  for (Step& step : surface_steps()) steps.push_back(std::move(step));
  room_then_ = &WorkcellDialogue::offer_block;
  ask_room(std::move(steps), &WorkcellDialogue::keep_room);
}

void WorkcellDialogue::offer_block() {
  is_yes_ = true;
  ask({[this] {
        return dialogue::yes_no_question(workcell_.blocks.empty() ? "A block?" : "Another block?",
                                         is_yes_,
                                         "Blocks can be added, changed and removed later as well.");
      }},
      &WorkcellDialogue::handle_offer);
}

void WorkcellDialogue::handle_offer() { is_yes_ ? add() : ask_camera(); }

// Name, workspace and surface.

/// Asks the questions about the draft; then `judge` checks the answers and may ask again.
void WorkcellDialogue::ask_room(std::deque<Step> steps, Action judge) {
  room_steps_ = std::move(steps);
  room_judge_ = judge;
  ask(room_steps_, judge);
}

void WorkcellDialogue::keep_room() {
  const Findings findings = dialogue::check(draft_, arm_);
  if (has_errors(findings)) {
    say(dialogue::notes(draft_, findings) + "Not valid. Please enter the items again:\n");
    return ask(room_steps_, room_judge_);
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

std::deque<WorkcellDialogue::Step> WorkcellDialogue::name_steps() {
  return {[this] {
            return dialogue::text_question("Name", 1, kMaxWorkcellName, draft_.name,
                                           "The name of this workcell.", {});
          },
          [this] {
            return dialogue::text_question("Notes", 0, kMaxNotesHeight, draft_.notes,
                                           "Any remarks; - for none.", {});
          }};
}

void WorkcellDialogue::name() {
  draft_ = workcell_;
  room_then_ = nullptr;
  ask_room(name_steps(), &WorkcellDialogue::keep_room);
}

std::deque<WorkcellDialogue::Step> WorkcellDialogue::workspace_steps() {
  Workspace& space = draft_.workspace;
  return {length_step("Workspace X, to the front", kAnySize, kAnySize, space.x_um,
                      "It reaches from the base, x = 0, to x = X."),
          length_step("Workspace Y, to either side", kAnySize, kAnySize, space.y_um,
                      "It reaches from y = -Y, right of the base, to y = Y, left of it."),
          length_step("Workspace Z, upwards", kAnySize, kAnySize, space.z_um,
                      "It reaches from the foot of the base, z = 0, to z = Z.")};
}

void WorkcellDialogue::workspace() {
  draft_ = workcell_;
  room_then_ = nullptr;
  ask_room(workspace_steps(), &WorkcellDialogue::keep_room);
}

std::deque<WorkcellDialogue::Step> WorkcellDialogue::surface_steps() {
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

void WorkcellDialogue::surface() {
  draft_ = workcell_;
  room_then_ = nullptr;
  ask_room(surface_steps(), &WorkcellDialogue::keep_room);
}

// The camera.

void WorkcellDialogue::camera() { ask_camera(); }

void WorkcellDialogue::ask_camera() {
  draft_ = workcell_;
  wants_camera_ = draft_.camera.has_value() || is_making_;
  ask({[this] {
        return dialogue::yes_no_question("A camera?", wants_camera_,
                                         "A fixed camera that looks straight down.");
      }},
      &WorkcellDialogue::handle_camera_answer);
}

void WorkcellDialogue::handle_camera_answer() {
  room_then_ = is_making_ ? &WorkcellDialogue::view : nullptr;
  is_making_ = false;
  if (!wants_camera_) {
    draft_.camera.reset();
    return keep_room();
  }
  if (!draft_.camera) draft_.camera = dialogue::proposed_camera(draft_);
  Camera& camera = *draft_.camera;
  projection_ = camera.projection == Projection::kPerspective ? 1 : 0;
  const Workspace& space = draft_.workspace;
  const Lengths above{draft_.work_surface_um + 1, kAnyPlace.max};
  const std::string field = "Of the work surface; its middle is under the camera.";
  std::deque<Step> steps = {
      length_step("Camera x", {0, space.x_um}, kAnyPlace, camera.location_um.x,
                  "Its position; it looks straight down."),
      length_step("Camera y", {-space.y_um, space.y_um}, kAnyPlace, camera.location_um.y,
                  "Its position; it looks straight down."),
      length_step("Camera z", above, above, camera.location_um.z,
                  "Above the work surface; in perspective above every block."),
      length_step("Field along x", {1, space.x_um}, kAnySize, camera.field_x_um, field),
      length_step("Field along y", {1, 2 * space.y_um}, kAnySize, camera.field_y_um, field),
      [&camera] {
        return dialogue::whole_question("Pixels along x", 1, kMaxCameraPixels, camera.pixels_x,
                                        "Columns of the image; 2 mm per pixel is fine.");
      },
      [&camera] {
        return dialogue::whole_question("Pixels along y", 1, kMaxCameraPixels, camera.pixels_y,
                                        "Rows of the image.");
      },
      [this] {
        return dialogue::choice_question(
            "Projection", {"orthographic", "perspective"}, projection_,
            "orthographic: straight down everywhere. perspective: as seen from the camera.");
      }};
  ask_room(std::move(steps), &WorkcellDialogue::finish_camera);
}

void WorkcellDialogue::finish_camera() {
  if (draft_.camera) {
    draft_.camera->projection =
        projection_ == 1 ? Projection::kPerspective : Projection::kOrthographic;
  }
  keep_room();
}

}  // namespace xr3
