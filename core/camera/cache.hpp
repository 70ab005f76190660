// Caches the camera's last image, so that it is rendered once per state, however often it is
// requested. An image is a pure function of camera, work surface, blocks, and faults of the camera
// at a tick, so the cache never changes a result; it is not part of the state.
//
// The flow through the folder: an inquiry of the camera reaches image(), row() or pixel(). After
// touch() the first of them compares the state with the scene that was drawn last: camera, work
// surface, and place and size of each block. If they are equal, the cached image is used. If not,
// the blocks at rest are drawn again; a held block is drawn onto a copy of their image, so that a
// moving arm costs one block. The first rows and pixels of a new scene are rendered alone by
// core/camera.hpp, since the whole image costs more than they do. sight.hpp projects the corners of
// a block onto the work surface with the camera's exact arithmetic, and fill.hpp sets the pixels
// inside their convex hull. Last, core/faults/camera_faults.hpp changes the image if a fault of the
// camera is in force at this tick.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/camera/sight.hpp"
#include "core/image.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

class CameraCache {
 public:
  CameraCache() = default;
  /// A copy of a machine has a cache of its own, which begins empty.
  CameraCache(const CameraCache& /*other*/) {}
  CameraCache& operator=(const CameraCache& other) {
    if (&other != this) touch();
    return *this;
  }
  ~CameraCache() = default;

  /// Call after any change of model or state: the next request then compares the cache with both.
  /// Without a call the cache is taken as valid, so that a request does not examine every block.
  void touch() { is_compared_ = false; }

  /// The image of camera_image() with the faults of the camera, shared.
  ImagePtr image(const Model& model, const State& state);
  /// The row of camera_row(); copied from the whole image if that is cached.
  Image row(const Model& model, const State& state, int row);
  /// The pixel of camera_pixel(); read from the whole image if that is cached.
  bool pixel(const Model& model, const State& state, int column, int row);

  /// The number of renderings: whole images, rows, and a held block drawn onto the others.
  std::uint64_t renders() const { return renders_; }

 private:
  /// Size and placement of a block.
  struct BlockPose {
    PointUm size_um;
    PointUm centroid_um;
    Microdegrees yaw_udeg = 0;
  };
  /// Everything that determines the image of the blocks at rest.
  struct Scene {
    Camera camera;
    Micrometres work_surface_um = 0;
    std::vector<BlockPose> places;
    std::optional<std::uint32_t> held;  ///< the block that is not at rest
  };

  ImagePtr clean_image(const Model& model, const State& state);
  static bool is_at(const Block& block, const BlockPose& place);
  bool is_same_scene(const Model& model, const State& state) const;
  void keep_scene(const Model& model, const State& state);
  void compare(const Model& model, const State& state);
  void draw_resting(const Model& model, const State& state);
  bool needs_only_a_part();

  std::optional<Scene> scene_;
  std::optional<BlockCorners> held_corners_;
  ImagePtr resting_;  ///< the blocks of the scene without the held one, or nullptr
  ImagePtr whole_;    ///< the whole image, or nullptr
  ImagePtr faulty_;   ///< the whole image with faults of the camera at faulty_tick_
  Tick faulty_tick_ = 0;
  bool is_compared_ = false;  ///< whether model and state have been compared since touch()
  int parts_ = 0;             ///< rows drawn separately in this scene
  std::uint64_t renders_ = 0;
};

}  // namespace xr3
