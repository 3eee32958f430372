#!/usr/bin/env bash
# Fails where a source is not formatted as .clang-format says. TypeScript and JavaScript are held to
# their style by the test Web.Style. With --fix they are formatted instead.
set -euo pipefail
cd "$(dirname "$0")/.."
options=(--dry-run -Werror)
[[ ${1:-} == --fix ]] && options=(-i)
git ls-files -co --exclude-standard '*.cc' '*.h' | xargs clang-format "${options[@]}"
