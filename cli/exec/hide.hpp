// The judge's own protection from the programs that it runs with the rights of the same user.
#pragma once

namespace xr3 {

/// To be called before anything else of a command that runs programs: no process of the same user
/// may read the memory, the environment or the open files of this one from here on, or trace it.
/// Overwrites the token in the environment.
void hide_from_programs();

}  // namespace xr3
