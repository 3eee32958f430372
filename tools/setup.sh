#!/usr/bin/env bash
# Installs the Debian packages that a build needs; with --tests or --bench also what those need.
# Does nothing where they are there already.
set -euo pipefail

packages=(g++ cmake ninja-build pkg-config ccache libceres-dev libeigen3-dev libglm-dev
          libtinygltf-dev libyaml-cpp-dev nlohmann-json3-dev libcli11-dev libfmt-dev libpng-dev
          libssl-dev libstb-dev libmujoco-dev libqhull-dev libgl-dev libcpp-httplib-dev
          python3-dev pybind11-dev python3-numpy)
# The report page is built with them; another installation of both will do.
command -v node >/dev/null || packages+=(nodejs)
command -v npm >/dev/null || packages+=(npm)
if [[ ${1:-} == --tests ]]; then
  packages+=(libgtest-dev libvalijson-dev clang-format python3-pytest parallel)
  [[ -x ${RETARGET_CHROMIUM:-/usr/bin/chromium} ]] || packages+=(chromium)
fi

[[ ${1:-} == --bench ]] && packages+=(libbenchmark-dev python3)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
((${#missing[@]} == 0)) && exit 0

if ! command -v apt-get >/dev/null; then
  echo "setup: no apt-get here; install by hand: ${missing[*]}" >&2
  exit 1
fi
as_root=()
[[ $(id -u) == 0 ]] || as_root=(sudo)
"${as_root[@]}" apt-get update -qq
DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}"
