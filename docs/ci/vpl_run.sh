#!/bin/bash
# Moodle VPL, an execution file: makes vpl_execution, which runs the first file of the submission and
# shows on the student's terminal what it prints, and which goals it has met.
set -eu

options=(--exercise 01-hello --max-seconds 60)
command=(python3)

# shellcheck source=/dev/null
[ ! -e vpl_environment.sh ] || . ./vpl_environment.sh

{
  echo '#!/bin/bash'
  printf 'exec %q exec' "${XR3:-xr3}"
  printf ' %q' "${options[@]}" -- "${command[@]}" "./$VPL_SUBFILE0"
  echo
} >vpl_execution
chmod +x vpl_execution
