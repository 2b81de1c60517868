# shellcheck shell=bash disable=SC2119,SC2120
# What ./demo and ./check share; they source it from the root of the checkout. For bash.

Say() { printf '== %s\n' "$*"; }

Fail() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# AsRoot COMMAND...: runs it with the rights to install packages.
AsRoot() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    Fail "packages are missing; run this as root or install sudo"
  fi
}

# InstallPackages [STAGE...]: installs what is missing of cmake/packages.txt, without the packages that only other
# stages need. Asks for neither rights nor network when nothing is missing.
InstallPackages() {
  if ! command -v dpkg-query >/dev/null; then
    Say "this is not Debian: taking for granted what cmake/packages.txt lists"
    return
  fi
  local package stage missing=()
  while read -r package stage; do
    case "$package" in '' | '#'*) continue ;; esac
    case " $* " in *" $stage "*) ;; *) [ -z "$stage" ] || continue ;; esac
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done <cmake/packages.txt
  [ ${#missing[@]} -gt 0 ] || return 0

  Say "installing ${missing[*]}"
  AsRoot apt-get -o DPkg::Lock::Timeout=300 update ||
    Say "apt-get update failed; trying with the package lists that are there"
  AsRoot env DEBIAN_FRONTEND=noninteractive \
    apt-get -o DPkg::Lock::Timeout=300 install -y --no-install-recommends "${missing[@]}" ||
    Fail "could not install ${missing[*]}"
}

# Configure PRESET [CMAKE OPTIONS...]: quiet unless it fails.
Configure() {
  local preset=$1 log="build/configure-$1.log"
  shift
  mkdir -p build
  cmake --preset "$preset" "$@" >"$log" 2>&1 || { cat "$log" >&2; Fail "configuring $preset failed"; }
}

# How many compilers may run at once: one a processor, and 1.5 GB of memory for each.
Jobs() {
  local processors memory_kb jobs
  processors=$(nproc)
  memory_kb=$(awk '/^MemTotal:/ { print $2 }' /proc/meminfo)
  jobs=$((memory_kb / 1500000))
  [ "$jobs" -le "$processors" ] || jobs=$processors
  [ "$jobs" -ge 1 ] || jobs=1
  echo "$jobs"
}

# The compiler cache needs a place to write to even where there is no home directory.
if [ -z "${CCACHE_DIR:-}" ] && ! [ -w "${HOME:-/nonexistent}" ]; then
  export CCACHE_DIR="$PWD/build/ccache"
fi
