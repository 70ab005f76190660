#!/usr/bin/env bash
# 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
# switch that closes at a known position. Searching for it tells where the joint is.
#
#     ./3_home.sh [HOST [PORT]]

cd "$(dirname "$0")" || exit
. ./robot.sh "$@"

# Where the switches close, in counts from the soft home: upper arm upright, forearm level, tool
# down. Seen from there each is open before this count, and closed from it on: for a few dozen
# counts on a real arm, for longer in the simulator.
declare -A place=([D]=40 [E]=-40 [C]=40 [B]=-25 [F]=30 [A]=16)

# One byte reports several switches: I those of joints C to F, J those of A and B. Each has one bit.
declare -A asked=([D]=I [E]=I [C]=I [B]=J [F]=I [A]=J)
declare -A bit=([D]=2 [E]=4 [C]=1 [B]=2 [F]=8 [A]=1)

stride=10  # counts of one move of the search; a switch stays closed for longer
widest=100 # more counts than a switch of a real arm stays closed
far=1600   # more counts than any joint has from a limit to its switch

# How far to search away from the soft home before trying the other direction. The shoulder must not
# lean far back, or the hand hits the base.
declare -A reach=([D]=$far [E]=60 [C]=$far [B]=$far [F]=$far [A]=$far)

# read_switch JOINT: sets $switch to the bit of the joint's switch. Some controllers report a closed
# switch as 1, others as 0.
read_switch() {
  robot_ask "${asked[$1]}"
  switch=$((((reply - 32) & ${bit[$1]}) != 0))
}

# step JOINT COUNTS: moves the joint. Sets $left to the counts that were left, 0 if it has arrived.
step() {
  robot_move "$1" "$2"
  robot_wait "$1" # as in example 2; cancels the move of a blocked joint
}

# changes JOINT COUNTS FARTHEST: moves in steps of COUNTS until the switch changes. Fails if it does
# not within FARTHEST counts, or before the joint is blocked.
changes() {
  local before gone
  read_switch "$1"
  before=$switch
  for ((gone = 0; gone < $3; gone += ${2#-})); do
    step "$1" "$2"
    read_switch "$1"
    [ "$switch" = "$before" ] || return 0
    [ "$left" = 0 ] || return 1
  done
  return 1
}

# find_near_edge JOINT AWAY: moves to the count at which the switch closes. Fails if the switch does
# not change.
find_near_edge() {
  # Watch the switch change, at whichever edge: first in one direction, then in the other. If it
  # reads like the closed ones before, the near edge lies towards the soft home.
  local way=$2 first=${reach[$1]}
  read_switch "$1"
  if [ "$switch" = "$closed" ]; then
    way=$((-$2))
    first=$far
  fi
  changes "$1" $((stride * way)) "$first" || changes "$1" $((-stride * way)) $((2 * far)) ||
    changes "$1" $((stride * way)) $((2 * far)) || return

  # Move towards the soft home until the switch has not changed for a long way: now it is open.
  while changes "$1" $((-stride * $2)) $widest; do :; done

  # Quickly up to the near edge, back again, and then count by count.
  changes "$1" $((stride * $2)) $far && changes "$1" $((-stride * $2)) $far &&
    changes "$1" "$2" $far
}

closed= # what a closed switch reads, 0 or 1: not known until the first one has changed

# The elbow comes first, since it lifts the hand off the table; the jaws, joint A, come last.
for joint in D E C B F A; do
  find_near_edge $joint $((place[$joint] > 0 ? 1 : -1)) ||
    give_up "the switch of $joint does not change. Is the joint blocked at a limit, or the arm \
stalled? Is the clock paused? (The examples 3 to 6 are for the Rhino XR-3 with its own workcell)"
  read_switch $joint
  closed=$switch
  printf '%s is on its switch, at %+d\n' $joint "${place[$joint]}"
done

# All switches at once. J also reports four input lines, in its bits 4 to 32.
robot_ask I
i=$((reply - 32))
robot_ask J
j=$(((reply - 32) & 3))
echo "a closed switch reads $closed; the switches of I are $i, those of J $j"

# The soft home is at count 0: move each joint back by the count of its switch.
for joint in D E C B F A; do
  step $joint $((-place[$joint]))
  [ "$left" = 0 ] || give_up_standing $joint "$left"
done
echo 'at the soft home'
