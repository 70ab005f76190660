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

step() {
  robot_move "$1" "$2"
  robot_wait "$1" # asks as in example 2, and stops the joint if it cannot go on
}

# The elbow comes first, for it lifts the hand off the table; the jaws, joint A, come last.
for joint in D E C B F A; do
  way=$((place[$joint] > 0 ? 1 : -1))
  until is_closed $joint; do step $joint $((5 * way)); done # quickly, until the switch closes
  while is_closed $joint; do step $joint $((-way)); done    # back, until it opens again
  until is_closed $joint; do step $joint $way; done         # slowly: now we know to the count
  printf '%s stands on its switch, at %+d\n' $joint "${place[$joint]}"
done

robot_ask I
i=$((reply - 32))
robot_ask J
j=$((reply - 32))
echo "switches closed: $i of I, $j of J"

# From here the soft home is as far away as the switches are from it.
for joint in D E C B F A; do step $joint $((-place[$joint])); done
echo 'at the soft home'
