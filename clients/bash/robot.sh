# shellcheck shell=bash

# What the examples 2 to 6 share: the line to the robot, and the few things that one says on it.
# Say `. ./robot.sh "$@"` at the start of a program: it connects to HOST and PORT of the
# arguments, else of XR3_HOST and XR3_PORT, else to localhost 9600.

# Bytes are bytes here, not letters of some language.
export LC_ALL=C

# A joint stands if its counter is the same after so many questions, in 2 seconds. The slowest speed
# is one count a second, and the simulator's clock may run slowly, so be patient.
stands_after=40

# give_up TEXT: says what is wrong and ends the program.
give_up() {
  echo "$1" >&2
  exit 1
}

# give_up_standing JOINT LEFT: the end of a program whose joint stands so many counts short of where
# it was sent.
give_up_standing() {
  give_up "$1 stands, $2 counts short of where it was sent. Is it blocked at a limit, or stalled? \
Is a block in the jaws? Does time stand, or run slowly? Look at the page or at \`xr3 watch\`"
}

host=${1:-${XR3_HOST:-localhost}}
port=${2:-${XR3_PORT:-9600}}
case $port in '' | *[!0-9]*) number=0 ;; *) number=$port ;; esac
if [ "$number" -lt 1 ] || [ "$number" -gt 65535 ]; then
  give_up "the port has to be a number from 1 to 65535, not '$port'"
fi
command -v nc >/dev/null || give_up 'nc (netcat) is missing: apt-get install netcat-openbsd'
# (-z only looks whether somebody is there.)
nc -z -w 5 "$host" "$port" 2>/dev/null ||
  give_up "no robot answers at $host port $port: is the server running? ./run"

# netcat runs beside the program: what we write into ${robot[1]} goes to the robot, and its
# answers are read from ${robot[0]}.
coproc robot { exec nc -N "$host" "$port"; }
exec {from_robot}<&"${robot[0]}" {to_robot}>&"${robot[1]}"
trap '' PIPE # if the line is closed, tell us, and do not just end the program

# Where the motors are, in counts from the soft home, as far as robot_go moved them.
declare -A at=([F]=0 [E]=0 [D]=0 [C]=0 [B]=0 [A]=0)

# robot_send TEXT: sends commands; the text is printf's. A move has to end with \r.
robot_send() {
  # shellcheck disable=SC2059  # it is a format
  printf "$1" 2>/dev/null 1>&"$to_robot" || give_up 'the robot has closed the line'
}

# robot_ask INQUIRY: asks, and leaves the byte that answers in $reply, as a number. (A byte of 0
# cannot be read here, for bash drops it: so these programs ask I and J for switches, never EV.)
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

# robot_to_go JOINT: leaves in $left how many counts the joint has still to go.
robot_to_go() {
  robot_ask "$1?"
  left=$((reply - 32))
}

# robot_wait JOINT: waits until the joint is there. One that stands, at a limit or with the jaws at a
# block, is stopped. Leaves in $left what was left to go.
robot_wait() {
  local before same=0 # how many answers in a row have been the same
  robot_to_go "$1"
  while [ "$left" -gt 0 ] && [ "$same" -lt "$stands_after" ]; do
    sleep 0.05
    before=$left
    robot_to_go "$1"
    if [ "$left" = "$before" ]; then same=$((same + 1)); else same=0; fi
  done
  [ "$left" = 0 ] || robot_send "$1X"
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
      [ "$left" = 0 ] || give_up_standing "$joint" "$left"
    done
  done
}

# robot_move JOINT COUNTS: starts a move and does not wait for it.
robot_move() {
  robot_send "$(printf '%s%+d' "$1" "$2")"'\r'
}
