#include "tools/workcell_editor/checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/inverse/empty_table.hpp"
#include "protocol/files/consistency.hpp"
#include "protocol/files/workcell.hpp"
#include "protocol/text/table.hpp"
#include "tools/workcell_editor/items.hpp"

namespace xr3::dialogue {
namespace {

constexpr const char* kOverlap = "a block that overlaps \"";
constexpr const char* kBlocks = "/blocks/";

/// The reach is checked from block `first_reach` on, because it can take long.
Findings file_findings(const Workcell& workcell, const Robot* robot, std::size_t first_reach = 0) {
  return read_workcell(workcell_to_json(workcell).dump(), "", robot, first_reach).findings;
}

std::string pointer_of(std::size_t block) { return kBlocks + std::to_string(block); }

/// The workcell with the block moved to the end: findings about a pair of blocks name the later
/// one.
Workcell with_last(const Workcell& workcell, std::size_t index, const Block& block) {
  Workcell result = workcell;
  std::vector<Block>& blocks = result.blocks.edit();
  if (index < blocks.size()) blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(index));
  blocks.push_back(block);
  return result;
}

bool is_about(const Finding& finding, std::size_t block) {
  const std::string pointer = pointer_of(block);
  return finding.pointer == pointer || finding.pointer.starts_with(pointer + "/");
}

/// The start of a note: the block's name or the member.
std::string subject(const Workcell& workcell, const Finding& finding) {
  if (!finding.pointer.starts_with(kBlocks)) {
    return finding.pointer.empty() ? "" : finding.pointer.substr(1) + ": ";
  }
  const std::size_t index = std::stoul(finding.pointer.substr(std::string(kBlocks).size()));
  return "\"" + workcell.blocks[index].name + "\": ";
}

Micrometres half_diagonal(const Block& block) {
  return static_cast<Micrometres>(
      std::hypot(static_cast<double>(block.size_um.x), static_cast<double>(block.size_um.y)) / 2);
}

bool is_apart(const Workcell& workcell, const Block& block) {
  constexpr Micrometres kGap = 10'000;
  return std::ranges::none_of(workcell.blocks, [&](const Block& other) {
    const double distance =
        std::hypot(static_cast<double>(block.centroid_um.x - other.centroid_um.x),
                   static_cast<double>(block.centroid_um.y - other.centroid_um.y));
    return distance < static_cast<double>(half_diagonal(block) + half_diagonal(other) + kGap);
  });
}

/// The points of a square grid over the workspace, from its centre outwards.
std::vector<PointUm> places(const Workspace& space, Micrometres field) {
  std::vector<PointUm> result;
  const Micrometres middle = space.x_um / 2 / field;
  for (Micrometres i = 1; i * field < space.x_um; ++i) {
    for (Micrometres j = -space.y_um / field; j <= space.y_um / field; ++j) {
      result.push_back({i * field, j * field, 0});
    }
  }
  std::ranges::stable_sort(result, {}, [&](const PointUm& p) {
    return std::max(std::abs(p.x / field - middle), std::abs(p.y / field));
  });
  return result;
}

std::string free_name(const Workcell& workcell) {
  for (std::size_t number = workcell.blocks.size() + 1;; ++number) {
    std::string name = "block " + std::to_string(number);
    if (std::ranges::find(workcell.blocks, name, &Block::name) == workcell.blocks.end())
      return name;
  }
}

/// The size of a proposed block: twice as long as wide, and half as wide as the maximum opening.
PointUm proposed_size(const Robot& robot) {
  constexpr double kEvenMm = 2;
  const double width = std::max(std::floor(widest_opening_mm(robot) / 4) * kEvenMm, kEvenMm);
  return {micrometres(2 * width), micrometres(width), micrometres(width)};
}

}  // namespace

Findings check(const Workcell& workcell, const Arm& arm) {
  return file_findings(workcell, &arm.robot);
}

Findings check_block(const Workcell& workcell, std::size_t index, const Block& block,
                     const Arm& arm) {
  const Workcell candidate = with_last(workcell, index, block);
  const std::size_t last = candidate.blocks.size() - 1;
  Findings findings = file_findings(candidate, &arm.robot, last);
  Findings own;
  for (Finding& finding : findings) {
    if (!is_about(finding, last)) continue;
    finding.pointer = pointer_of(std::min(index, workcell.blocks.size()));
    own.push_back(std::move(finding));
  }
  return own;
}

std::string notes(const Workcell& workcell, const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text += "  ! " + subject(workcell, finding) + finding.found + "; allowed: " + finding.allowed +
            "\n";
  }
  return text;
}

std::string jaws_note(const Block& block, const Robot& robot) {
  const double narrow = mm(std::min(block.size_um.x, block.size_um.y));
  const double widest = widest_opening_mm(robot);
  if (narrow < widest) return "";
  return "  ! too wide to be grasped: the jaws of " + robot.name + " open " + plain_number(widest) +
         " mm\n";
}

Micrometres resting_z(const Workcell& workcell, std::size_t index, Block block) {
  const Workcell others = with_last(workcell, index, block);
  const Micrometres half = block.size_um.z / 2;
  block.centroid_um.z = workcell.work_surface_um + half;
  for (std::size_t tries = 0; tries < others.blocks.size(); ++tries) {
    const Micrometres before = block.centroid_um.z;
    const Workcell candidate = with_last(workcell, index, block);
    for (const Finding& finding : file_findings(candidate, nullptr)) {
      if (!is_about(finding, candidate.blocks.size() - 1)) continue;
      for (const Block& other : others.blocks) {
        if (finding.found != kOverlap + other.name + "\"") continue;
        const Micrometres top = other.centroid_um.z + other.size_um.z / 2;
        block.centroid_um.z = std::max(block.centroid_um.z, top + half);
      }
    }
    if (block.centroid_um.z == before) break;
  }
  return block.centroid_um.z;
}

Workcell proposed_workcell(const Arm& arm) {
  Workcell workcell = empty_table(arm.reach);
  workcell.name = "my workcell";
  return workcell;
}

Block proposed_block(const Workcell& workcell, const Arm& arm) {
  constexpr int kMaxTries = 150;  // bounds the response time
  constexpr int kFirstBrightColor = 9;
  constexpr std::size_t kBrightColors = 6;
  Block block;
  block.name = free_name(workcell);
  block.size_um = proposed_size(arm.robot);
  block.color = kFirstBrightColor + static_cast<int>(workcell.blocks.size() % kBrightColors);
  const Workspace& space = workcell.workspace;
  const Micrometres least = std::max<Micrometres>(std::min(space.x_um, space.y_um) / 40, 1);
  constexpr Micrometres kRound = 10'000;
  const Micrometres field =
      (std::max({2 * kRound, least, half_diagonal(block)}) + kRound - 1) / kRound * kRound;
  int tries = arm.reach.is_quick() ? kMaxTries : 1;
  for (const PointUm& place : places(space, field)) {
    block.centroid_um = {place.x, place.y, workcell.work_surface_um + block.size_um.z / 2};
    if (!is_apart(workcell, block)) continue;
    if (arm.reach.has_grasp(block)) return block;
    if (--tries == 0) break;
  }
  block.centroid_um.x = space.x_um / 2;
  block.centroid_um.y = 0;
  return block;
}

Camera proposed_camera(const Workcell& workcell) {
  constexpr Micrometres kMm = 1000;
  constexpr Micrometres kAbove = 300 * kMm;
  constexpr int kPixels = 192;
  const Workspace& space = workcell.workspace;
  const Micrometres field =
      std::max<Micrometres>(std::min(space.x_um, 2 * space.y_um) * 16 / 25 / kMm * kMm, kMm);
  Camera camera;
  camera.location_um = {space.x_um / 2, 0, std::max(space.z_um, workcell.work_surface_um) + kAbove};
  camera.field_x_um = field;
  camera.field_y_um = field;
  camera.pixels_x = kPixels;
  camera.pixels_y = kPixels;
  return camera;
}

}  // namespace xr3::dialogue
