// The members of an `image` message: the camera's image as JSON. A row is a text of 0 and 1, or a
// list of run lengths. A pure function of the image.
#pragma once

#include <string>

#include "core/image.hpp"
#include "protocol/json/source.hpp"
#include "protocol/monitor/request.hpp"

namespace xr3 {

/// All members of an `image` message except op, cell, epoch, seq and tick. Rows are ordered from
/// the top, pixels from the left. With kRle each row is a list of run lengths that starts with a
/// run of zeros, which has length 0 if the first pixel is 1.
Json image_json(const Image& image, monitor::Encoding encoding);

/// The text of image_json(), built without intermediate JSON values.
std::string image_text(const Image& image, monitor::Encoding encoding);

}  // namespace xr3
