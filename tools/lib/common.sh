# Shared by the scripts of tools and .ci, and used by CI; sourced, not run.

emmy_root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
# EMMY_JOBS limits parallel work, for machines with little memory.
emmy_jobs="${EMMY_JOBS:-$(nproc)}"

# Usage message of a script: the comment block at its top.
emmy_help() {
  sed -n '2,/^[^#]/{/^#/!d;s/^# \{0,1\}//;p}' "$1"
}

emmy_say() {
  printf '\n==> %s\n' "$*" >&2
}

# Debian packages of the named groups, one a line.
emmy_packages() {
  local group
  for group in "$@"; do
    sed -n "s/^${group}  *\([^ ][^ ]*\) .*/\1/p" \
      "${emmy_root}/tools/lib/packages.txt"
  done
}

emmy_missing_packages() {
  local package
  for package in $(emmy_packages "$@"); do
    # dpkg-query also knows removed packages, so the status has to be read.
    case "$(dpkg-query --show --showformat='${db:Status-Abbrev}' \
      "${package}" 2>/dev/null)" in
      ii*) ;;
      *) printf '%s\n' "${package}" ;;
    esac
  done
}

# Installs what is missing of the named groups, or says how and exits with 2.
emmy_install() {
  local missing as_root=()
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    emmy_say "Not a Debian system; expecting the equivalents of:" \
      $(emmy_packages "$@")
    return 0
  fi
  missing="$(emmy_missing_packages "$@")"
  [[ -n "${missing}" ]] || return 0
  missing="${missing//$'\n'/ }"

  if [[ "$(id -u)" -ne 0 ]]; then
    if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
      as_root=(sudo -n)
    else
      printf 'Missing packages. Run this as root, then try again:\n\n  %s %s\n' \
        'apt-get install -y --no-install-recommends' "${missing}" >&2
      exit 2
    fi
  fi
  emmy_say "Installing ${missing}"
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
    apt-get -o DPkg::Lock::Timeout=300 -q)
  # Old package lists may still do where no mirror answers; install decides.
  "${apt[@]}" update >&2 || emmy_say "apt-get update failed, going on"
  # Unquoted on purpose: one argument a package.
  if ! "${apt[@]}" install -y --no-install-recommends ${missing} >&2; then
    printf 'Installation failed. What is missing: %s\n' "${missing}" >&2
    exit 2
  fi
}

# As emmy_install, for packages that only some tests need: these are skipped
# where it fails, and say so. Other distributions may call them otherwise.
emmy_install_optional() {
  local missing
  command -v dpkg-query >/dev/null || return 0
  missing="$(emmy_missing_packages "$@")"
  (emmy_install "$@") || emmy_say "Going on without" ${missing}
}

# Configures and builds a preset; further arguments are targets.
emmy_build() {
  local preset="$1" target targets=()
  shift
  for target in "$@"; do targets+=(--target "${target}"); done
  cd "${emmy_root}" || exit 1
  emmy_say "Building preset ${preset}"
  cmake --preset "${preset}" >&2 &&
    cmake --build --preset "${preset}" --parallel "${emmy_jobs}" \
      "${targets[@]}" >&2
}
