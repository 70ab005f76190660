#!/bin/sh
# Makes xr3 available in a pipeline of Debian: from its package, or built from the checkout that this file is in.
#
#     get-xr3.sh
#
# XR3_PACKAGE is the address or the path of a package, xr3_VERSION_amd64.deb; without it, xr3 is built.
# XR3_PACKAGE_SHA256, if it is set, is the digest that the package must have.
# XR3_CACHE is a folder that the pipeline keeps: for downloaded packages, and for what the compiler made.
set -eu

if [ -n "${XR3_CACHE-}" ]; then
  mkdir -p "$XR3_CACHE/apt/partial" "$XR3_CACHE/ccache"
  cache=$(cd "$XR3_CACHE" && pwd)
  export CCACHE_DIR="$cache/ccache" CCACHE_MAXSIZE=500M
  if [ "$(id -u)" = 0 ]; then
    # (Debian's images delete what apt has downloaded.)
    rm -f /etc/apt/apt.conf.d/docker-clean
    printf '%s\n' "Dir::Cache::Archives \"$cache/apt\";" 'Binary::apt-get::APT::Keep-Downloaded-Packages "true";' \
      'APT::Sandbox::User "root";' >/etc/apt/apt.conf.d/90xr3-cache
  fi
fi

apt_get() {
  if [ "$(id -u)" = 0 ]; then apt-get "$@"; else sudo apt-get "$@"; fi
}

case ${XR3_PACKAGE-} in
  '') exec "$(dirname "$0")/../../run" --build ;;
  *://*)
    package=$(mktemp -d)/xr3.deb
    command -v curl >/dev/null || { apt_get update; apt_get install -y --no-install-recommends ca-certificates curl; }
    curl -fsSL --retry 3 -o "$package" "$XR3_PACKAGE"
    ;;
  *) package=$(cd "$(dirname "$XR3_PACKAGE")" && pwd)/$(basename "$XR3_PACKAGE") ;;
esac
[ -z "${XR3_PACKAGE_SHA256-}" ] || printf '%s  %s\n' "$XR3_PACKAGE_SHA256" "$package" | sha256sum --check --quiet -
apt_get install -y --no-install-recommends "$package"
# At the same place as one that is built.
mkdir -p "$(dirname "$0")/../../build/release"
ln -sf "$(command -v xr3)" "$(dirname "$0")/../../build/release/xr3"
xr3 --version
