# shellcheck shell=bash

# Shared by examples 2 to 6: the connection to the robot and its basic commands. Put
# `. ./robot.sh "$@"` at the start of a program: it connects to HOST and PORT from the arguments,
# else XR3_HOST and XR3_PORT, else localhost 9600.

# Treat text as bytes, not as characters of a locale.
export LC_ALL=C

# A joint counts as stopped if its counter is the same after this many questions, over 2 seconds.
# The slowest speed is one count per second, and the simulator's clock may run slowly, hence the
# long wait.
stands_after=40

# give_up TEXT: prints a message and ends the program.
give_up() {
  echo "$1" >&2
  exit 1
}

# give_up_standing JOINT LEFT: ends the program because a joint has stopped LEFT counts short of its
# target.
give_up_standing() {
  give_up "$1 stopped $2 counts short of its target. Is it blocked at a limit, or stalled? Is a \
block in the jaws? Is the clock paused or slow? Look at the page or at \`xr3 watch\`"
}

host=${1:-${XR3_HOST:-localhost}}
port=${2:-${XR3_PORT:-9600}}
case $port in '' | *[!0-9]*) number=0 ;; *) number=$port ;; esac
if [ "$number" -lt 1 ] || [ "$number" -gt 65535 ]; then
  give_up "the port has to be a number from 1 to 65535, not '$port'"
fi
command -v nc >/dev/null || give_up 'nc (netcat) is missing: apt-get install netcat-openbsd'
# (-z only checks that the port accepts connections.)
nc -z -w 5 "$host" "$port" 2>/dev/null ||
  give_up "no robot answers at $host port $port: is the server running? ./run"

# netcat runs as a coprocess: bytes written to ${robot[1]} go to the robot, and answers are read
# from ${robot[0]}.
coproc robot { exec nc -N "$host" "$port"; }
exec {from_robot}<&"${robot[0]}" {to_robot}>&"${robot[1]}"
trap '' PIPE # on a closed connection, report an error instead of ending the program

# Motor positions in counts from the soft home, as tracked by robot_go.
declare -A at=([F]=0 [E]=0 [D]=0 [C]=0 [B]=0 [A]=0)

# robot_send TEXT: sends commands; the text is a printf format. A move must end with \r.
robot_send() {
  # shellcheck disable=SC2059  # the text is a format
  printf "$1" 2>/dev/null 1>&"$to_robot" || give_up 'the robot has closed the line'
}

# robot_ask INQUIRY: sends an inquiry and sets $reply to the one-byte answer as a number. (bash
# drops bytes of 0; the answers to ?, I and J have none.)
robot_ask() {
  local byte
  robot_send "$1"
  IFS= read -r -N 1 -t 5 -u "$from_robot" byte # a robot answers at once
  case $? in
    0) ;;
    1) give_up 'the robot has closed the line' ;;
    *) give_up 'no robot answers like this; is it the monitor port? The robot port is 9600' ;;
  esac
  printf -v reply '%d' "'$byte"
  reply=$((reply & 255))
}

# robot_to_go JOINT: sets $left to the counts that the joint still has to go. A Mark III answers
# with seven bits: for more than 95 counts the answer is wrong there, so no move of these programs
# is longer.
robot_to_go() {
  robot_ask "$1?"
  left=$((reply - 32))
}

# robot_pause: pauses between two questions: 50 ms, or XR3_POLL_MS.
robot_pause() {
  local ms=${XR3_POLL_MS:-50}
  sleep "$((ms / 1000)).$(printf '%03d' $((ms % 1000)))"
}

# robot_wait JOINT: waits until the joint has arrived. If it is blocked (at a limit, or jaws at a
# block), cancels its move. Sets $left to the counts that were left.
robot_wait() {
  local before same=0 # number of equal answers in a row
  robot_to_go "$1"
  while [ "$left" -gt 0 ] && [ "$same" -lt "$stands_after" ]; do
    robot_pause
    before=$left
    robot_to_go "$1"
    if [ "$left" = "$before" ]; then same=$((same + 1)); else same=0; fi
  done
  [ "$left" = 0 ] || robot_send "$1X"
}

# robot_go JOINT COUNT...: moves these motors to these counts together, in parts small enough for
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
      [ "$left" = 0 ] || give_up_standing "$joint" "$left"
    done
  done
}

# robot_move JOINT COUNTS: starts a move and does not wait for it.
robot_move() {
  robot_send "$(printf '%s%+d' "$1" "$2")"'\r'
}
