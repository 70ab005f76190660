#!/bin/sh
# Runs commands against a fresh robot. Its exit code is 0 if all of them succeeded.
#
#     with-xr3.sh 'python3 my_program.py' 'python3 my_check.py'
#
# Each argument is a shell command. They run one after the other and find the robot by XR3_HOST and
# XR3_PORT. The last one is the check: only it gets the monitor port and its token, XR3_MONITOR_PORT and
# XR3_TOKEN, so that a program under test can neither read the result nor make it. (A single command gets
# the port, and needs no token.) A command that takes longer than XR3_TIME_LIMIT seconds (600) is ended.
# The ports are free ones, so any number of these may run at once. If a command fails, the server's log is
# shown. XR3 names the executable, if it is neither the checkout's own nor an installed one; XR3_OPTIONS are
# the options of `xr3 serve`, if they are not to be `--clock real:50`: time fifty times as fast.
set -eu

[ $# -gt 0 ] || { echo "usage: $0 'COMMAND'..." >&2; exit 2; }

xr3=${XR3:-$(dirname "$0")/../../build/release/xr3}
[ -x "$xr3" ] || xr3=$(command -v xr3) || { echo "$0: there is no xr3; run get-xr3.sh" >&2; exit 2; }
folder=$(mktemp -d)
mkfifo "$folder/output"

# The server reads the token from a pipe, so that no file or environment has it while a program runs.
token=''
private=''
if [ $# -gt 1 ]; then
  token=$(od -An -N16 -tx1 /dev/urandom | tr -d ' \n')
  private='--private --token-file /dev/fd/5'
fi
unset XR3_TOKEN
(umask 077 && mkfifo "$folder/token")
printf '%s' "$token" >"$folder/token" &
exec 5<"$folder/token"
rm "$folder/token"

# XR3_LISTEN is cleared: this server listens only on this machine. The server limits its log file to the
# last 50 MB, however long the program under test sends garbage; standard error has only the reason
# why it does not start.
# shellcheck disable=SC2086  # options are words
XR3_LISTEN='' XR3_LOG_FILE="$folder/log" \
  "$xr3" serve --robot-port 0 --monitor-port 0 $private ${XR3_OPTIONS---clock real:50} \
  >"$folder/output" 2>"$folder/errors" &
server=$!
exec 5<&-

running=
finish() {
  code=$?
  trap '' INT TERM
  # (by both names: its session may still be to come)
  [ -z "$running" ] || kill -- "-$running" "$running" 2>/dev/null || true
  kill "$server" 2>/dev/null || true
  [ -z "$running" ] || wait "$running" 2>/dev/null || true
  wait "$server" 2>/dev/null || true
  [ "$code" = 0 ] || { echo "--- log of xr3:"; cat "$folder/errors" "$folder/log" 2>/dev/null || true; } >&2
  rm -rf "$folder"
  exit "$code"
}
trap finish EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# Runs one command. A shell hears a signal at once only while it waits, so the command is in the
# background: in a session of its own, so that all of it can be ended, and with what `&` takes from
# it, standard input and its signals.
run() {
  setsid timeout --kill-after=5 "${XR3_TIME_LIMIT:-600}" env --default-signal=INT,QUIT sh -c "$1" <&4 3<&- 4<&- &
  running=$!
  code=0
  wait "$running" || code=$?
  [ "$code" != 124 ] || echo "$0: ended after ${XR3_TIME_LIMIT:-600} s (XR3_TIME_LIMIT): $1" >&2
  kill -- "-$running" 2>/dev/null || true  # what it left running
  running=
  return "$code"
}

# The server says one line, when both of its ports take connections: LISTENING robot=HOST:PORT
# monitor=HOST:PORT. No sleeping, no asking again: read waits for it, and fails if the server ends
# instead.
exec 3<"$folder/output"
read -r listening <&3
XR3_HOST=localhost
robot=${listening#*robot=}
robot=${robot%% *}
XR3_PORT=${robot##*:}  # a host may have colons, too
monitor_port=${listening##*:}
export XR3_HOST XR3_PORT
unset XR3_MONITOR_PORT

exec 4<&0
left=$#
for command; do
  left=$((left - 1))
  if [ "$left" = 0 ]; then
    export XR3_MONITOR_PORT="$monitor_port"
    [ -z "$token" ] || export XR3_TOKEN="$token"
  fi
  echo "\$ $command"
  run "$command"
done
