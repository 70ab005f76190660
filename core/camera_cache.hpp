// The camera's last picture, kept so that it is made once for a state however often it is asked for.
// A picture is a pure function of camera, work surface and blocks, so a cache never changes an
// answer; it is no part of the state.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/camera_sight.hpp"
#include "core/image.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

class CameraCache {
 public:
  /// What is kept is compared with the model and the state at the next question. Without this call it
  /// counts as true, so that a question costs no look at ten thousand blocks.
  void touch() { is_compared_ = false; }

  /// camera_image(). Valid as long as somebody holds it.
  ImagePtr image(const Model& model, const State& state);
  /// camera_row(); cut out of the whole picture where there is one.
  Image row(const Model& model, const State& state, int row);
  /// camera_pixel(); read in the whole picture where there is one.
  bool pixel(const Model& model, const State& state, int column, int row);

  /// How often blocks were drawn: whole pictures, rows, and a held block onto the others.
  std::uint64_t renders() const { return renders_; }

 private:
  /// Where a block rests.
  struct Place {
    PointUm size_um;
    PointUm centroid_um;
    Microdegrees yaw_udeg = 0;
  };
  /// All that the blocks at rest look like.
  struct Scene {
    Camera camera;
    Micrometres work_surface_um = 0;
    std::vector<Place> places;
    std::optional<std::uint32_t> held;  ///< the block that is not at rest
  };

  static bool is_at(const Block& block, const Place& place);
  bool is_same_scene(const Model& model, const State& state) const;
  void keep_scene(const Model& model, const State& state);
  void compare(const Model& model, const State& state);
  void draw_resting(const Model& model, const State& state);
  bool needs_only_a_part();

  std::optional<Scene> scene_;
  std::optional<BlockCorners> held_corners_;
  ImagePtr resting_;          ///< the blocks of the scene without the held one, or null
  ImagePtr whole_;            ///< the whole picture, or null
  bool is_compared_ = false;  ///< with the model and the state as they are now
  int parts_ = 0;             ///< rows that were drawn by themselves in this scene
  std::uint64_t renders_ = 0;
};

}  // namespace xr3
