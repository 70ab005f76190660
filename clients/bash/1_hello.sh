#!/usr/bin/env bash
# 1. Hello: connect to the robot, ask it two questions, print the answers.
#
#     ./1_hello.sh [HOST [PORT]]
#
# The robot's serial protocol has no lines of text and no "OK". The robot answers most questions
# with one byte and does not answer other commands.

# Host and port: from the arguments, else from the environment, else the defaults.
host=${1:-${XR3_HOST:-localhost}}
port=${2:-${XR3_PORT:-9600}}

give_up() {
  echo "$1" >&2
  exit 1
}

case $port in '' | *[!0-9]*) number=0 ;; *) number=$port ;; esac
if [ "$number" -lt 1 ] || [ "$number" -gt 65535 ]; then
  give_up "the port has to be a number from 1 to 65535, not '$port'"
fi
command -v nc >/dev/null || give_up 'nc (netcat) is missing: apt-get install netcat-openbsd'
# (-z only checks that the port accepts connections.)
nc -z -w 5 "$host" "$port" 2>/dev/null ||
  give_up "no robot answers at $host port $port: is the server running? ./run"

# E? asks for the remaining counts of the shoulder, joint E; I asks which microswitches are closed.
# netcat (nc) sends the three bytes and receives the two answers; -N closes the connection after the
# last byte, and -w 5 gives up after 5 seconds of silence. od prints the received bytes as numbers.
answers=$(printf 'E?I' | nc -N -w 5 "$host" "$port" | od -An -tu1)
read -r to_go switches more <<<"$answers"
if [ -z "$switches" ] || [ -n "$more" ]; then
  give_up 'no robot answers like this; is it the monitor port? The robot port is 9600'
fi

# 32, the code of a blank, is added to the answer to make it printable: a blank means 0 counts to
# go, "!" means 1, and so on. The same holds for the switches; each has one bit.
echo "E? is answered by $to_go: $((to_go - 32)) counts to go"
echo "I is answered by $switches: switches $((switches - 32))"
