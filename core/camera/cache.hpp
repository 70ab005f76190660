// Caches the camera's last image, so that it is rendered once per state, however often it is
// requested. An image is a pure function of camera, work surface, blocks, and faults of the camera
// at a tick, so the cache never changes a result; it is not part of the state.
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
  /// Call after any change of model or state: the next request then compares the cache with both.
  /// Otherwise the cache is assumed to be valid, so that a request does not examine ten thousand
  /// blocks.
  void touch() { is_compared_ = false; }

  /// camera_image() with the faults of the camera, shared.
  ImagePtr image(const Model& model, const State& state);
  /// camera_row(); copied from the whole image if it is cached.
  Image row(const Model& model, const State& state, int row);
  /// camera_pixel(); read from the whole image if it is cached.
  bool pixel(const Model& model, const State& state, int column, int row);

  /// The number of renderings: whole images, rows, and a held block drawn onto the others.
  std::uint64_t renders() const { return renders_; }

 private:
  /// Size and placement of a block.
  struct Place {
    PointUm size_um;
    PointUm centroid_um;
    Microdegrees yaw_udeg = 0;
  };
  /// Everything that determines the image of the blocks at rest.
  struct Scene {
    Camera camera;
    Micrometres work_surface_um = 0;
    std::vector<Place> places;
    std::optional<std::uint32_t> held;  ///< the block that is not at rest
  };

  ImagePtr clean_image(const Model& model, const State& state);
  static bool is_at(const Block& block, const Place& place);
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
  bool is_compared_ = false;  ///< with the current model and state
  int parts_ = 0;             ///< rows drawn separately in this scene
  std::uint64_t renders_ = 0;
};

}  // namespace xr3
