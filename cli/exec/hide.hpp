// The judge's own protection from the programs that it runs with the rights of the same user.
#pragma once

namespace xr3 {

/// Hides this process from programs of its user: from this call on none may read its memory, its
/// environment or its open files, or trace it. Overwrites the token in the environment. Call before
/// anything else in a command that runs programs.
void hide_from_programs();

}  // namespace xr3
