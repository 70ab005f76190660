// The effect of each command on the machine (paper, Tables VI and VII; hardware for K...R). Serial
// lines change the state only through execute().
#pragma once

#include "core/camera/cache.hpp"
#include "core/command.hpp"
#include "core/event.hpp"
#include "core/model.hpp"
#include "core/state.hpp"

namespace xr3 {

/// Executes a command at the state's tick. A label without a joint accepts every command, does
/// nothing, replies like a joint at rest and emits a warning. Precondition: camera.touch() was
/// called after any change since the cache was used.
Reply execute(const Model& model, State& state, const Command& command, Events& events,
              CameraCache& camera);

/// Whether the command only reads the camera, and so changes nothing that the camera sees.
bool is_camera_inquiry(const Command& command);

}  // namespace xr3
