// A wire frame laid out on a sheet of pixels: what an SVG text or a raster shows, before it is either.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/palette.hpp"
#include "core/view.hpp"
#include "core/wireframe.hpp"

namespace xr3 {

inline constexpr int kPictureMarginPx = 20;
inline constexpr int kLeastPictureWidthPx = 100;
inline constexpr int kMostPictureWidthPx = 4000;

/// A sheet; x runs to the right and y down from its left upper corner, in pixels.
struct Picture {
  int width_px = 0;
  int height_px = 0;
  Background background = Background::kLight;
  std::string title;
  std::vector<FlatWire> wires;
};

/// The least rectangle around these extents and every point of the wires.
Extents around(Extents extents, const std::vector<FlatWire>& wires);

/// Fits the extents into a sheet of this width, kLeast... to kMost..., with one scale for both axes. Its
/// height follows, up to twice the width; what is higher still is drawn smaller, in the middle.
Picture lay_out(const std::vector<FlatWire>& wires, const Extents& extents, int width_px);

/// How thick a part is drawn.
double line_width_px(const std::string& part);

}  // namespace xr3
