#include "protocol/explain/line_notes.hpp"

#include "protocol/explain/diagnostic.hpp"
#include "protocol/line/device_command.hpp"

namespace xr3 {

ProblemNote disabled_note() {
  const Problem problem{ProblemCode::kDisabled, Subject::kNone};
  return {code_of(problem.code), describe(Parsed{}, problem), 0, {}, 1};
}

ProblemNote cooked_note() {
  return {"pty_cooked",
          "the program's terminal echoes or edits lines: replies come back as commands, and bytes "
          "wait for Enter; set it raw, as with stty raw -echo",
          0,
          {},
          1};
}

ProblemNote hurry_note(char label) {
  return {"byte_clock_hurry",
          std::string(1, label) +
              " gets another motion command before it has arrived, and no inquiry came since: a "
              "program that sleeps instead of asking needs --clock real; the byte clock stands "
              "while it sleeps",
          0,
          {},
          1};
}

ProblemNote silent_note(const Command& inquiry) {
  return {"device_silent",
          "the device has not answered " + readable(for_device(inquiry)->bytes) +
              " within half a second; the inquiry is forgotten",
          0,
          {},
          1};
}

}  // namespace xr3
