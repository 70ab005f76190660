#!/usr/bin/env bash
# 3. Home by microswitches: after power-on the position of the arm is unknown. Each joint has a
# switch that closes at a known position. Searching for it tells where the joint is.
#
#     ./3_home.sh [HOST [PORT]]

cd "$(dirname "$0")" || exit
. ./robot.sh "$@"

# Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool down.
declare -A place=([D]=40 [E]=-40 [C]=40 [B]=-25 [F]=30 [A]=16)

# One byte reports several switches: I those of joints C to F, J those of A and B. Each has one bit,
# which is 1 if the switch is closed.
declare -A asked=([D]=I [E]=I [C]=I [B]=J [F]=I [A]=J)
declare -A bit=([D]=2 [E]=4 [C]=1 [B]=2 [F]=8 [A]=1)

is_closed() {
  robot_ask "${asked[$1]}"
  [ $(((reply - 32) & ${bit[$1]})) -ne 0 ]
}

# step JOINT COUNTS: moves the joint. Sets $left to the counts that were left, 0 if it has arrived.
step() {
  robot_move "$1" "$2"
  robot_wait "$1" # as in example 2; cancels the move of a blocked joint
}

# look_for JOINT COUNTS: one step of the loops below, which end when the switch is closed or open.
# Gives up if the joint is blocked or has moved its full travel.
farthest=2500 # more counts than the full travel of any joint
gone=0
look_for() {
  step "$1" "$2"
  gone=$((gone + ${2#-} - left))
  if [ "$left" = "${2#-}" ] || [ "$gone" -gt "$farthest" ]; then
    give_up "$1 went $gone counts and found no switch. Is it blocked at a limit, or stalled? Is \
the clock paused? (The examples 3 to 6 are for the Rhino XR-3 with its own workcell, in the \
profile paper)"
  fi
}

# Some controllers report their switches inverted. The answer to I shows it: the highest of its six
# bits belongs to no switch and should be 0.
robot_ask I
if [ $((reply - 32)) -ge 32 ]; then
  give_up "the switches of D and of all other joints read 1 when they are open, as in the profile \
mark3. This example is for the profile paper"
fi

# The elbow comes first, since it lifts the hand off the table; the jaws, joint A, come last.
for joint in D E C B F A; do
  way=$((place[$joint] > 0 ? 1 : -1))
  gone=0
  until is_closed $joint; do look_for $joint $((5 * way)); done  # quickly, until the switch closes
  while is_closed $joint; do look_for $joint $((-5 * way)); done # back, until it opens again
  until is_closed $joint; do look_for $joint $way; done          # slowly, to find the exact count
  printf '%s is on its switch, at %+d\n' $joint "${place[$joint]}"
done

robot_ask I
i=$((reply - 32))
robot_ask J
j=$((reply - 32))
echo "switches closed: $i of I, $j of J"

# The soft home is at count 0: move each joint back by the count of its switch.
for joint in D E C B F A; do
  step $joint $((-place[$joint]))
  [ "$left" = 0 ] || give_up_standing $joint "$left"
done
echo 'at the soft home'
