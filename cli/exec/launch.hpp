// The start of a program under test: all that happens between fork and exec. Where the system
// allows it, the program runs in a PID namespace of its own, whose first process, its keeper, waits
// for it: with the keeper the system ends every process of the namespace.
#pragma once

#include <sys/types.h>

#include "cli/exec/pipe.hpp"
#include "cli/exec/program.hpp"

namespace xr3 {

/// The standard streams of a program. A closed end of `input` for writing: the program reads
/// nothing.
struct StandardPipes {
  Pipe input;
  Pipe output;
  Pipe error;
};

struct Launched {
  ::pid_t process;  ///< the program, or its keeper; leader of a group and a session
  bool is_keeper;
  Descriptor status;  ///< has the wait status of the program, if its keeper has ended; else empty
};

/// Starts the program. Throws std::system_error if it is missing, or not executable.
Launched launch(const ProgramSettings& settings, const StandardPipes& pipes);

}  // namespace xr3
