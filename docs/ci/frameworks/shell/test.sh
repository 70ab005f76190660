#!/bin/sh
# Tests each program of this folder that has goals: NAME.sh by NAME.json. Fails if one misses a goal.
cd "$(dirname "$0")" || exit
failed=0
for goals in *.json; do
  name=${goals%.json}
  if report=$("${XR3:-xr3}" exec --quiet --goals "$goals" -- "./$name.sh" 2>&1); then
    echo "ok $name"
  else
    failed=1
    printf 'FAILED %s\n%s\n' "$name" "$report"
  fi
done
exit "$failed"
