# shellcheck shell=bash

# What the examples 2 to 6 share: the line to the robot, and the few things that one says on it.
# Say `. ./robot.sh "$@"` at the start of a program: it connects to HOST and PORT of the
# arguments, else of XR3_HOST and XR3_PORT, else to localhost 9600.

# Bytes are bytes here, not letters of some language.
export LC_ALL=C

# netcat runs beside the program: what we write into ${robot[1]} goes to the robot, and its
# answers are read from ${robot[0]}.
coproc robot { exec nc -N "${1:-${XR3_HOST:-localhost}}" "${2:-${XR3_PORT:-9600}}"; }
exec {from_robot}<&"${robot[0]}" {to_robot}>&"${robot[1]}"

# Where the motors are, in counts from the soft home, as far as robot_go moved them.
declare -A at=([F]=0 [E]=0 [D]=0 [C]=0 [B]=0 [A]=0)

# robot_send TEXT: sends commands; the text is printf's. A move has to end with \r.
robot_send() {
  # shellcheck disable=SC2059  # it is a format
  printf "$1" >&"$to_robot"
}

# robot_ask INQUIRY: asks, and leaves the byte that answers in $reply, as a number. (A byte of 0
# cannot be read here, for bash drops it: so these programs ask I and J for switches, never EV.)
robot_ask() {
  local byte
  robot_send "$1"
  IFS= read -r -N 1 -u "$from_robot" byte || { echo "the robot has closed the line" >&2; exit 1; }
  printf -v reply '%d' "'$byte"
  reply=$((reply & 255))
}

# robot_to_go JOINT: leaves in $left how many counts the joint has still to go.
robot_to_go() {
  robot_ask "$1?"
  left=$((reply - 32))
}

# robot_wait JOINT: waits until the joint is there. One that makes no count between two questions
# stands, at a limit or with the jaws at a block, and is stopped. Leaves in $left what was left to
# go.
robot_wait() {
  local before
  robot_to_go "$1"
  while [ "$left" -gt 0 ]; do
    sleep 0.05 # time enough for a count at 20 counts a second and more
    before=$left
    robot_to_go "$1"
    if [ "$left" = "$before" ]; then
      robot_send "$1X"
      break
    fi
  done
}

# robot_go JOINT COUNT...: brings these motors to these counts together, in parts small enough for
# the error counter.
robot_go() {
  local -A start wanted
  local joint way longest=0 parts part next
  while [ $# -gt 0 ]; do
    start[$1]=${at[$1]}
    wanted[$1]=$2
    way=$(($2 - ${at[$1]}))
    [ "${way#-}" -le "$longest" ] || longest=${way#-}
    shift 2
  done
  parts=$(((longest + 59) / 60)) # no move is longer than 60 counts
  for ((part = 1; part <= parts; part++)); do
    for joint in "${!wanted[@]}"; do
      next=$((${start[$joint]} + (${wanted[$joint]} - ${start[$joint]}) * part / parts))
      way=$((next - ${at[$joint]}))
      robot_move "$joint" "$way"
      at[$joint]=$next
    done
    for joint in "${!wanted[@]}"; do
      robot_wait "$joint"
      [ "$left" = 0 ] || { echo "$joint stands and is not where it was sent" >&2; exit 1; }
    done
  done
}

# robot_move JOINT COUNTS: starts a move and does not wait for it.
robot_move() {
  robot_send "$(printf '%s%+d' "$1" "$2")"'\r'
}
