// Codecs for the parts of a block: name, lengths in whole micrometres, yaw in whole microdegrees.
// Shared by workcell files and the calls that change a workcell, so that their ranges are the same.
#pragma once

#include <string>

#include "core/workcell.hpp"
#include "protocol/json/codec.hpp"

namespace xr3::data {

/// The range of sizes.
inline constexpr Range kSize{0, kMaxLengthMm, true};

/// A length, kept in whole micrometres; the range is in mm.
Codec<Micrometres> length_um(Range range);

/// Three lengths, kept in whole micrometres; `names` are their names, such as "[x, y, z]".
Codec<PointUm> point_um(Range range, const std::string& names);

/// An angle of -360...360 degrees, kept in (-180, 180] degrees.
Codec<Microdegrees> yaw();

Codec<std::string> block_name();
Codec<PointUm> block_size();
Codec<PointUm> block_centroid();
/// A palette index.
Codec<int> block_color();

/// A block of a workcell file.
Members<Block> block_members();

}  // namespace xr3::data
