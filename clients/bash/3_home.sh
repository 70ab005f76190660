#!/usr/bin/env bash
# 3. Home by microswitches: after power-on nobody knows where the arm stands. Each joint has a
# switch that closes at one place of its way. Looking for that place is how a robot finds out.
#
#     ./3_home.sh [HOST [PORT]]

cd "$(dirname "$0")" || exit
. ./robot.sh "$@"

# Where the switches are, in counts from the soft home: upper arm upright, forearm level, tool down.
declare -A place=([D]=40 [E]=-40 [C]=40 [B]=-25 [F]=30 [A]=16)

# One byte tells of several switches: I of joints C to F, J of A and B. Each has a bit of its own,
# which is 1 where the switch is closed.
declare -A asked=([D]=I [E]=I [C]=I [B]=J [F]=I [A]=J)
declare -A bit=([D]=2 [E]=4 [C]=1 [B]=2 [F]=8 [A]=1)

is_closed() {
  robot_ask "${asked[$1]}"
  [ $(((reply - 32) & ${bit[$1]})) -ne 0 ]
}

# step JOINT COUNTS: moves the joint. Leaves in $left how many counts were left, if it could not go
# on.
step() {
  robot_move "$1" "$2"
  robot_wait "$1" # asks as in example 2, and stops a joint that stands
}

# look_for JOINT COUNTS: one step for the loops below, which go on until the switch is closed,
# or open. A joint that cannot go on, or has gone its whole way, will never get there.
farthest=2500 # no joint has so many counts to go from one end of its way to the other
gone=0
look_for() {
  step "$1" "$2"
  gone=$((gone + ${2#-} - left))
  if [ "$left" = "${2#-}" ] || [ "$gone" -gt "$farthest" ]; then
    give_up "$1 went $gone counts and found no switch. Is it blocked at a limit, or stalled? Does \
time stand? (The examples 3 to 6 are for the Rhino XR-3 with its own workcell, in the profile paper)"
  fi
}

# A robot may tell of its switches the other way round. I shows it: the highest of its six bits
# belongs to no switch, and should be 0.
robot_ask I
if [ $((reply - 32)) -ge 32 ]; then
  give_up "the switches of D and of all other joints tell 1 when they are open, as in the profile \
mark3. This example is for the profile paper"
fi

# The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
for joint in D E C B F A; do
  way=$((place[$joint] > 0 ? 1 : -1))
  gone=0
  until is_closed $joint; do look_for $joint $((5 * way)); done  # quickly, until the switch closes
  while is_closed $joint; do look_for $joint $((-5 * way)); done # back, until it opens again
  until is_closed $joint; do look_for $joint $way; done          # slowly: now we know to the count
  printf '%s stands on its switch, at %+d\n' $joint "${place[$joint]}"
done

robot_ask I
i=$((reply - 32))
robot_ask J
j=$((reply - 32))
echo "switches closed: $i of I, $j of J"

# From here the soft home is as far away as the switches are from it.
for joint in D E C B F A; do
  step $joint $((-place[$joint]))
  [ "$left" = 0 ] || give_up_standing $joint "$left"
done
echo 'at the soft home'
