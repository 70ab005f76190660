#!/usr/bin/env bash
# The steps of the action in action.yml. Its inputs are the variables INPUT_NAME.
#
#     action.sh install   installs the release INPUT_VERSION, or builds xr3 from the checkout of the action
#     action.sh judge     runs INPUT_PROGRAM; writes the job's summary, annotations, and the output `folder`
set -eu -o pipefail

here=$(cd "$(dirname "$0")" && pwd)

refuse() {
  echo "::error title=xr3::$1"
  exit 2
}

install() {
  local version=${INPUT_VERSION-}
  if [ -n "$version" ]; then
    [[ $version =~ ^[0-9][0-9A-Za-z.~-]*$ ]] || refuse "the input version is a release such as 0.10.0"
    XR3_PACKAGE=$GITHUB_SERVER_URL/$GITHUB_ACTION_REPOSITORY/releases/download/v$version
    XR3_PACKAGE=$XR3_PACKAGE/xr3_${version}_$(dpkg --print-architecture).deb
    export XR3_PACKAGE
  fi
  exec "$here/get-xr3.sh"
}

# Runs a command without the variables of the job: tokens, and the files in which GitHub reads results.
without_the_job() (
  for name in $(compgen -e); do
    case $name in ACTIONS_* | GITHUB_* | INPUT_* | RUNNER_*) unset "$name" ;; esac
  done
  exec "$@"
)

judge() {
  local xr3=${XR3:-$here/../../build/release/xr3} options=() program=() name value code=0 folder token
  for name in goals exercise robot workcell clock repeat; do
    value=INPUT_${name^^}
    [ -z "${!value-}" ] || options+=("--$name=${!value}")
  done
  read -r -d '' -a program <<<"${INPUT_PROGRAM-}" || true
  [ ${#program[@]} -gt 0 ] || refuse "the input program names none"
  folder=$(mktemp -d "$RUNNER_TEMP/xr3-XXXXXX")
  echo "folder=$folder" >>"$GITHUB_OUTPUT"

  # GitHub executes no line that the program prints.
  token=$(od -An -N16 -tx1 /dev/urandom | tr -d ' \n')
  echo "::stop-commands::$token"
  without_the_job "$xr3" exec "${options[@]}" --out "$folder/runs" --json "$folder/result.json" --junit "$folder/junit.xml" \
    --markdown "$folder/summary.md" --github "$folder/annotations.txt" -- "${program[@]}" 2>&1 || code=$?
  printf '\n::%s::\n' "$token"

  [ -e "$folder/summary.md" ] || refuse "the program was not judged: the log of this step says why"
  cat "$folder/summary.md" >>"$GITHUB_STEP_SUMMARY"
  cat "$folder/annotations.txt"
  return "$code"
}

case ${1-} in
  install | judge) "$1" ;;
  *) echo "usage: $0 install|judge" >&2; exit 2 ;;
esac
