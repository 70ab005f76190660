#include "protocol/explain/warning_text.hpp"

#include <array>
#include <cstdio>

#include "protocol/explain/diagnostic.hpp"
#include "protocol/json/values.hpp"

namespace xr3 {
namespace {

/// Letters in the order of the alphabet, consecutive ones as A...F: `A...D, G`.
std::string runs_of(const std::string& letters) {
  std::string text;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const bool continues = i > 0 && letters[i] == letters[i - 1] + 1;
    const bool ends = i + 1 == letters.size() || letters[i + 1] != letters[i] + 1;
    if (!continues) text += (i > 0 ? ", " : "") + letter_text(letters[i]);
    if (continues && ends) text += "..." + letter_text(letters[i]);
  }
  return text;
}

std::string camera_text(const Model& model) {
  const auto& camera = model.workcell().camera;
  if (!camera) return "this workcell has no camera; not answered";
  return "the camera has columns 0..." + std::to_string(camera->pixels_x - 1) + " and rows 0..." +
         std::to_string(camera->pixels_y - 1) + "; not answered";
}

// The explanation of a line's bytes knows no names; see wire::WarningRaised.
std::string block_text(const std::string& name, const char* without_name) {
  return name.empty() ? without_name : "block " + name;
}

/// Whether the warning is about the carousel: its label says so.
bool is_of_carousel(const Warning& warning, const Model& model) {
  return model.carousel() && model.index_of(warning.label) == model.carousel_index();
}

std::string air_text(const Warning& warning, const Model& model) {
  const char* surface = warning.block.empty()            ? "what is below it"
                        : is_of_carousel(warning, model) ? "the carousel"
                                                         : "the work surface";
  return block_text(warning.block, "the block") + " was released " +
         short_number(mm(Micrometres{warning.value})) + " mm above " +
         block_text(warning.other, surface) + " and stays in the air: release it lower";
}

std::string overlap_text(const Warning& warning, const Model& model) {
  if (is_of_carousel(warning, model)) {
    return block_text(warning.block, "the block") +
           " overlaps the carousel: put it on its top or beside it";
  }
  const int more = warning.value - 1;
  return block_text(warning.block, "the block") + " overlaps " +
         block_text(warning.other, "another block") +
         (more > 0 ? " and " + std::to_string(more) + " more" : "") + ": put it where no block is";
}

}  // namespace

std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string text_of(const Warning& warning, const Model& model) {
  const std::string label = letter_text(warning.label);
  switch (warning.code) {
    case WarningCode::kCounterOverflow:
      return label + signed_number(warning.value) + ": the 8-bit error counter wrapped to " +
             std::to_string(warning.limit) + "; wait until " + label +
             " is nearer to its target before sending more";
    case WarningCode::kNoSuchJoint:
      return label + ": this robot has no such joint; it has " + runs_of(model.labels());
    case WarningCode::kBadCameraArgument: return camera_text(model);
    case WarningCode::kJawsTooNarrow:
      return "the jaws are already narrower than block " + warning.block +
             ": open them before closing on it";
    case WarningCode::kJawsTouch:
      return "the jaws stopped at the width of block " + warning.block +
             " and do not hold it: close them further";
    case WarningCode::kBelowSurface:
      return std::string("the tool tip passed under the work surface") +
             (model.carousel() ? " or the top of the carousel" : "");
    case WarningCode::kReleasedInAir: return air_text(warning, model);
    case WarningCode::kBlocksOverlap: return overlap_text(warning, model);
  }
  return "";
}

}  // namespace xr3
