#!/bin/bash
# Moodle VPL, an execution file: makes vpl_execution, which judges the first file of the submission.
# The exercise and the options are for you to change. Keep xr3_judge.py when running, and the exercise if it is a file
# of yours.
set -eu

options=(--exercise 01-hello --max-seconds 60)
command=(python3)

# VPL_SUBFILE0 is the name of the file, VPL_GRADEMIN and VPL_GRADEMAX are the grades of the activity.
# shellcheck source=/dev/null
[ ! -e vpl_environment.sh ] || . ./vpl_environment.sh

# All words are quoted: a student may have chosen the name of the file. The script is one line that
# becomes Python, so no program can change a line of it that is still to come.
{
  echo '#!/bin/bash'
  printf 'export VPL_GRADEMIN=%q VPL_GRADEMAX=%q; ' "${VPL_GRADEMIN:-0}" "${VPL_GRADEMAX:-10}"
  printf 'exec python3 -I xr3_judge.py vpl'
  printf ' %q' "${options[@]}" -- "${command[@]}" "./$VPL_SUBFILE0"
  echo
} >vpl_execution
chmod +x vpl_execution
