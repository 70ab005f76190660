#!/usr/bin/env bash
# 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
# switch that closes at a known position. Searching for it tells where the joint is.
#
#     ./3_home.sh [HOST [PORT]]

cd "$(dirname "$0")" || exit
. ./robot.sh "$@"

# Counts at which the switches close, from the soft home: upper arm upright, forearm level, tool
# down. Seen from there each is open before this count, and closed from it on: for a few dozen
# counts on a real arm, for longer in the simulator.
declare -A place=([D]=40 [E]=-40 [C]=40 [B]=-25 [F]=30 [A]=-16)

# One byte reports several switches: I those of joints C to F, J those of A and B. Each has one bit.
declare -A asked=([D]=I [E]=I [C]=I [B]=J [F]=I [A]=J)
declare -A bit=([D]=2 [E]=4 [C]=1 [B]=32 [F]=8 [A]=16)

stride=10 # counts of one move of the search; a switch stays closed for longer
far=1600  # more counts than any joint has from a limit to its switch
lean=400  # counts forward that bring the shoulder out of its backmost position

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

# search JOINT AWAY: moves until the switch closes, usually away from the soft home first. Fails if
# it does not close.
search() {
  if [ "$1" = E ]; then # forwards first: a shoulder that leans back folds the arm into its base
    changes E $stride $lean || changes E -$stride $((2 * far))
    return
  fi
  changes "$1" $((stride * $2)) $far && return
  if [ "$1" = D ]; then # the shoulder may lean far back: it must not when the forearm comes down
    changes E $stride $lean
  fi
  changes "$1" $((-stride * $2)) $((2 * far))
}

# find_near_edge JOINT: moves to the count at which the switch closes. Fails if the switch does not
# change.
find_near_edge() {
  local away=$((place[$1] > 0 ? 1 : -1))
  read_switch "$1"
  [ "$switch" = "$closed" ] || search "$1" $away || return
  # Back until the switch opens, and then count by count until it closes.
  changes "$1" $((-stride * away)) $far && changes "$1" $away $far
}

# The open jaws are at the end of their travel, and on their switch. It opens when they close.
changes A -$stride $far
read_switch A
closed=$switch # the reading of a closed switch, 0 or 1

# A shoulder on its switch may lean far back: it comes forward before the forearm moves.
read_switch E
[ "$switch" != "$closed" ] || find_near_edge E

# The jaws have shown how a closed switch reads. The elbow follows, since it lifts the hand off the
# table.
for joint in A D E C B F; do
  find_near_edge $joint ||
    give_up "the switch of $joint does not change. Is the joint blocked at a limit, or the arm \
stalled? Is the clock paused? (The examples 3 to 6 are for the Rhino XR-3 with its own workcell)"
  printf '%s is on its switch, at %+d\n' $joint "${place[$joint]}"
done

# All switches at once. J also reports four input lines, in its bits 1 to 8.
robot_ask I
i=$((reply - 32))
robot_ask J
j=$(((reply - 32) & 48))
echo "a closed switch reads $closed; the switches of I are $i, those of J $j"

# The soft home is at count 0: move each joint back by the count of its switch.
for joint in A D E C B F; do
  step $joint $((-place[$joint]))
  [ "$left" = 0 ] || give_up_standing $joint "$left"
done
echo 'at the soft home'
