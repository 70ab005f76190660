#include "server/files/raster.hpp"

#include <algorithm>
#include <cmath>

namespace xr3 {
namespace {

constexpr Rgb kWhite{255, 255, 255};
constexpr Rgb kNight{0x14, 0x17, 0x1c};

double distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d way = b - a;
  const double length2 = way.squaredNorm();
  const double along = length2 > 0 ? std::clamp((p - a).dot(way) / length2, 0.0, 1.0) : 0.0;
  return (p - a - along * way).norm();
}

/// The pixels low...high - 1, clipped to 0...size.
struct Span {
  int low;
  int high;
};

Span pixels_around(double a, double b, double reach, int size) {
  const double low = std::floor(std::min(a, b) - reach);
  const double high = std::ceil(std::max(a, b) + reach);
  return {static_cast<int>(std::clamp<double>(low, 0, size)),
          static_cast<int>(std::clamp<double>(high, 0, size))};
}

std::uint8_t blended(std::uint8_t below, std::uint8_t above, float cover) {
  return static_cast<std::uint8_t>(
      std::lround(static_cast<float>(below) * (1 - cover) + static_cast<float>(above) * cover));
}

/// Draws one polyline at a time: first computes its coverage of each pixel, then blends its colour
/// once, so that joints of the polyline are not darker.
class Pen {
 public:
  explicit Pen(Raster& raster) : raster_(raster), cover_(raster.pixels.size()) {}

  void draw(const FlatWire& wire, const Rgb& color) {
    const double half = line_width_px(wire.part) / 2;
    for (std::size_t i = 1; i < wire.points.size(); ++i) {
      cover_line(wire.points[i - 1], wire.points[i], half);
    }
    for (const std::size_t pixel : touched_) {
      for (std::size_t c = 0; c < color.size(); ++c) {
        raster_.pixels[pixel][c] = blended(raster_.pixels[pixel][c], color[c], cover_[pixel]);
      }
      cover_[pixel] = 0;
    }
    touched_.clear();
  }

 private:
  void cover_line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double half) {
    const Span rows = pixels_around(a.y(), b.y(), half + 1, raster_.height_px);
    const Span columns = pixels_around(a.x(), b.x(), half + 1, raster_.width_px);
    for (int y = rows.low; y < rows.high; ++y) {
      for (int x = columns.low; x < columns.high; ++x) {
        const double beyond = distance({x + 0.5, y + 0.5}, a, b) - half;
        if (beyond < 0.5) cover_pixel(x, y, static_cast<float>(std::min(0.5 - beyond, 1.0)));
      }
    }
  }

  void cover_pixel(int x, int y, float share) {
    const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(raster_.width_px) +
                       static_cast<std::size_t>(x);
    if (cover_[pixel] == 0) touched_.push_back(pixel);
    cover_[pixel] = std::max(cover_[pixel], share);
  }

  Raster& raster_;
  std::vector<float> cover_;
  std::vector<std::size_t> touched_;
};

}  // namespace

Raster rasterized(const Picture& picture) {
  const Rgb ground = picture.background == Background::kLight ? kWhite : kNight;
  const std::size_t pixels =
      static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px);
  Raster raster{picture.width_px, picture.height_px, std::vector<Rgb>(pixels, ground)};
  Pen pen(raster);
  for (const FlatWire& wire : picture.wires) {
    pen.draw(wire, color_rgb(wire.color, picture.background));
  }
  return raster;
}

}  // namespace xr3
