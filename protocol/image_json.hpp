// The `image` message's members: the camera's picture as JSON, a text of 0 and 1 a row or run lengths. A
// pure function of the picture.
#pragma once

#include <string>

#include "core/image.hpp"
#include "protocol/json_source.hpp"
#include "protocol/monitor_request.hpp"

namespace xr3 {

/// Every member of an `image` message but op, cell, epoch, seq and tick. Rows go from the top, each from
/// the left; with kRle each row is its run lengths, beginning with zeros (a 0 where it begins with ones).
Json image_json(const Image& image, monitor::Encoding encoding);

/// The text of image_json() without the values between: for pictures that are sent whole.
std::string image_text(const Image& image, monitor::Encoding encoding);

}  // namespace xr3
