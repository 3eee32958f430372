#!/usr/bin/env bash
# The installed library, used as others would: embed_test.sh BUILD SOURCE
# Installs to a temporary prefix, builds the example and embed_twice against it, runs both; then the
# same example on the project as a sub-directory, configured and compiled.
set -euo pipefail
build=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
example=$source/tools/examples/embed hold=$source/data/holds/bear_hug

cmake --install "$build" --component devel --prefix "$work/prefix" >/dev/null
if grep -rnE '#include "(model|solver|io|tools)/' "$work/prefix/include"; then
  echo "an installed header includes by the name it has in the source tree" >&2
  exit 1
fi

cp -r "$example" "$work/embed"
cmake -S "$work/embed" -B "$work/built" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$work/built"
"$work/built/embed" $hold/a.bvh $hold/b.bvh $hold/template.yaml | tee "$work/out.txt"
grep -q 'smallest s GLI 0\.[5-9]' "$work/out.txt"

mkdir "$work/twice"
cp "$source/tests/package/embed_twice.cc" "$work/twice/"
cat >"$work/twice/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.22)
project(twice LANGUAGES CXX)
find_package(Threads REQUIRED)
find_package(retarget 0.1 REQUIRED)
add_executable(embed_twice embed_twice.cc)
target_link_libraries(embed_twice PRIVATE retarget::retarget Threads::Threads)
CMAKE
cmake -S "$work/twice" -B "$work/twice/built" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
cmake --build "$work/twice/built"
"$work/twice/built/embed_twice" $hold >"$work/printed.txt" 2>&1
if [[ -s $work/printed.txt ]]; then
  echo "the library printed:" >&2
  cat "$work/printed.txt" >&2
  exit 1
fi

mkdir "$work/sub"
cp "$example/embed.cc" "$work/sub/"
cat >"$work/sub/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.23)
project(game LANGUAGES CXX)
add_subdirectory($source retarget)
add_executable(game embed.cc)
target_link_libraries(game PRIVATE retarget::retarget)
CMAKE
cmake -S "$work/sub" -B "$work/sub/built" -G Ninja -DRETARGET_STUDIO=OFF >/dev/null
ninja -C "$work/sub/built" CMakeFiles/game.dir/embed.cc.o
