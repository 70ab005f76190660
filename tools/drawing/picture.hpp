// The robot in its workcell as a wire frame in pixel coordinates, from which an SVG or a raster
// image is made, for `xr3 draw` and the monitor port.
//
// The flow through the folder: view_vector.hpp parses the direction of view. drawing() takes a
// model and a state, makes the wire frame with core/drawing (polylines in the base frame), adds the
// work surface, projects all of it onto the view and calls lay_out(), which fits the extents into a
// picture of the wanted width with one scale for both axes. The Picture has polylines in pixels, in
// the order of drawing, each with the name and colour of its part. svg.hpp writes it as text;
// server/files/raster.hpp rasterizes it, and server/files/png.hpp encodes the pixels. Other callers
// may lay out wires of their own, such as those of a state in the past. pbm.hpp is for the other
// kind of picture, the binary image of the overhead camera: it writes it as a plain bitmap, which a
// shell script can read. Nothing here reads or writes a file.
#pragma once

#include <string>
#include <vector>

#include "core/drawing/palette.hpp"
#include "core/drawing/view.hpp"
#include "core/drawing/wireframe.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

inline constexpr int kPictureMarginPx = 20;
inline constexpr int kMinPictureWidthPx = 100;
inline constexpr int kMaxPictureWidthPx = 4000;
inline constexpr int kUsualPictureWidthPx = 900;

/// A picture. The origin is the upper left corner; x to the right, y down, in pixels.
struct Picture {
  int width_px = 0;
  int height_px = 0;
  Background background = Background::kLight;
  std::string title;
  std::vector<FlatWire> wires;
};

/// The smallest rectangle that contains these extents and every point of the wires.
Extents around(Extents extents, const std::vector<FlatWire>& wires);

/// Fits the extents into a picture of this width, kMinPictureWidthPx...kMaxPictureWidthPx, with
/// the same scale for both axes. The height follows, up to twice the width; higher extents are
/// scaled down and centred.
Picture lay_out(const std::vector<FlatWire>& wires, const Extents& extents, int width_px);

/// The current wire frame with the work surface, seen along the vector. The picture is large enough
/// for the parts outside the paper's view plane. `width_px`:
/// kMinPictureWidthPx...kMaxPictureWidthPx.
Picture drawing(const Model& model, const State& state, const ViewVector& view, int width_px);

/// Line width of a part.
double line_width_px(const std::string& part);

}  // namespace xr3
