#!/usr/bin/env bash
# Holds the numbers of tests in BUILD_DIR/tests.xml (JUnit, from CTest) against tests/expected_counts.
# usage: tools/count_tests.sh BUILD_DIR
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=${1:?usage: tools/count_tests.sh BUILD_DIR}
# What CMake was told, or else what stands beside the checkout.
shared=$(sed -n 's/^RETARGET_SHARED_DIR:PATH=//p' "$build/CMakeCache.txt")
data=without_shared_data
[[ -e ${shared:-$root/../shared}/data/README.md ]] && data=with_shared_data

# From the attributes of the first element, <testsuite tests="..." skipped="..." ...>.
awk -v data="$data" '
  function number(text, name) {
    if (!match(text, "[ \t]" name "=\"?[0-9]+")) return -1
    text = substr(text, RSTART, RLENGTH)
    gsub(/[^0-9]/, "", text)
    return text + 0
  }
  FILENAME ~ /expected_counts$/ { if ($1 == data) bounds = $0; next }
  /<testcase/ { exit }
  { suite = suite " " $0 }
  END {
    skipped = number(suite, "skipped") + number(suite, "disabled")
    run = number(suite, "tests") - skipped
    least = number(bounds, "run_at_least"); most = number(bounds, "skipped_at_most")
    if (run < 0 || skipped < 0 || least < 0 || most < 0) {
      print "count_tests: cannot read the numbers" > "/dev/stderr"
      exit 2
    }
    printf "%d tests ran (at least %d), %d were skipped (at most %d), %s\n", run, least, skipped,
           most, data
    if (run < least) print "count_tests: too few tests ran" > "/dev/stderr"
    if (skipped > most) print "count_tests: too many tests were skipped" > "/dev/stderr"
    exit run < least || skipped > most
  }' "$root/tests/expected_counts" "$build/tests.xml"
