# Shared by the self-tests in this folder; sourced, not run.
#
#   sample PATH <<'END' … END     writes a file of the sample tree
#   expect_ok CHECK               the check accepts the tree
#   expect_problem CHECK TEXT     the check fails and names TEXT
#
# Both expectations end with an empty tree for the next variant.

folder_of_checks="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
tree="$(mktemp -d)"
trap 'rm -rf "${tree}"' EXIT
failures=0
variants=0

sample() {
  mkdir -p "$(dirname "${tree}/$1")"
  cat >"${tree}/$1"
}

next_variant() {
  variants=$((variants + 1))
  rm -rf "${tree}"
  mkdir "${tree}"
}

expect_ok() {
  local output
  if ! output="$(bash "${folder_of_checks}/$1" "${tree}" 2>&1)"; then
    printf 'variant %d: %s should accept this tree but says:\n%s\n' \
      "${variants}" "$1" "${output}"
    failures=$((failures + 1))
  fi
  next_variant
}

expect_problem() {
  local output
  if output="$(bash "${folder_of_checks}/$1" "${tree}" 2>&1)"; then
    printf 'variant %d: %s accepts a wrong tree (expected: %s)\n' \
      "${variants}" "$1" "$2"
    failures=$((failures + 1))
  elif ! grep -qF -- "$2" <<<"${output}"; then
    printf 'variant %d: %s fails without naming "%s":\n%s\n' \
      "${variants}" "$1" "$2" "${output}"
    failures=$((failures + 1))
  fi
  next_variant
}

finish() {
  printf '%d variants, %d failures\n' "${variants}" "${failures}"
  [[ "${failures}" -eq 0 && "${variants}" -gt 1 ]]
}
