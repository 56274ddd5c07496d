# Shared by the checks in this folder; sourced, not run.
#
# Each check is called with the project's root as its only argument, prints one
# line a problem, and exits with 1 if there is any. Each has a <name>_self_test
# beside it that runs the check on small wrong trees: a check that has not been
# seen to fail proves nothing.

# Files below the given folders (or "."), without builds and the repository's
# own data, as paths relative to the current folder, one a line.
project_files() {
  local folders=() folder
  for folder in "$@"; do
    [[ ! -e "${folder}" ]] || folders+=("${folder}")
  done
  [[ "${#folders[@]}" -gt 0 ]] || return 0
  find "${folders[@]}" \( -name .git -o -name .cache -o -path ./build \) \
    -prune -o -type f -print | sed 's|^\./||' | LC_ALL=C sort
}

cpp_files() {
  project_files lib verification tools python examples tests |
    grep -E '\.(h|cc|inc)$' || true
}

# Prints the problems it reads; fails if there are any.
report_problems() {
  local problems
  problems="$(cat)"
  [[ -z "${problems}" ]] && return 0
  printf '%s\n' "${problems}"
  printf '%s problem(s) found by %s\n' "$(grep -c '' <<<"${problems}")" \
    "$(basename "$0")"
  return 1
}
