// Converts workcell files (paper, Section III-B) from text to values and back. The text comes from
// the caller; no file is read here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/robot.hpp"
#include "core/workcell.hpp"
#include "protocol/json/codec.hpp"
#include "protocol/json/finding.hpp"

namespace xr3 {

/// Maximum number of blocks of a workcell in files and calls.
inline constexpr std::size_t kMaxFileBlocks = 256;
/// Maximum number of columns and of rows of a camera in files and calls.
inline constexpr int kMaxFilePixels = 1000;
/// Maximum number of columns and of rows of a camera in recordings and snapshots.
inline constexpr int kMaxSavedPixels = 2048;

/// Bounds of blocks and pixels. Recordings and snapshots may be of earlier versions, which allowed
/// more: up to kMaxBlocks and kMaxSavedPixels.
enum class WorkcellBounds : std::uint8_t { kFile, kSaved };

/// Reads and checks a workcell file; with a robot, also whether the blocks fit its tool
/// and, from index `first_reach` on, whether it can reach them: see check_workcell(). Syntax errors
/// are findings, too. Never throws.
FileReading<Workcell> read_workcell(std::string_view text, const std::string& file,
                                    const Robot* robot = nullptr, std::size_t first_reach = 0,
                                    WorkcellBounds bounds = WorkcellBounds::kFile);

/// Reads the workcell of a document that is being read, and checks it like read_workcell(); errors
/// go to the reading.
std::optional<Workcell> read_workcell(data::Reading& reading, const Robot* robot = nullptr,
                                      std::size_t first_reach = 0,
                                      WorkcellBounds bounds = WorkcellBounds::kFile);

/// Reads and checks a workcell file. Throws DataError with all findings if one of them is an error.
Workcell load_workcell(std::string_view text, const std::string& file);

/// The JSON of a workcell file, in mm, with its members in the documented order. Loading it gives
/// an equal workcell.
Json workcell_to_json(const Workcell& workcell);

}  // namespace xr3
