#!/usr/bin/env bash
# The Debian packages, unpacked into a root of their own: deb_test.sh BUILD
# The program runs its main job there on the data that came with it, from another folder.
set -euo pipefail
build=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
(cd "$work" && cpack --config "$build/CPackConfig.cmake" -B "$work/packages" >"$work/cpack.txt" 2>&1) ||
  { cat "$work/cpack.txt"; exit 1; }
for package in "$work"/packages/*.deb; do
  dpkg-deb -x "$package" "$work/root"
  dpkg-deb -f "$package" Package Version Depends
done
root=$work/root
for file in usr/bin/retarget usr/share/man/man1/retarget.1 usr/lib/x86_64-linux-gnu/libretarget.a \
  usr/include/retarget/retarget.h usr/share/bash-completion/completions/retarget \
  usr/share/zsh/vendor-completions/_retarget usr/share/fish/vendor_completions.d/retarget.fish \
  usr/share/retarget/templates/side_headlock.yaml; do
  [[ -s $root/$file || -s $root/${file/x86_64-linux-gnu\//} ]] || { echo "missing: $file" >&2; exit 1; }
done
# The add-on is a folder of its own in its archive.
[[ -s $root/usr/share/retarget/retarget_blender.zip ]] || { echo "missing: the add-on" >&2; exit 1; }
# The module, where the build made one.
module=$root/usr/lib/python3/dist-packages
if compgen -G "$build/python/retarget/_retarget*.so" >/dev/null; then
  env -i PATH=/usr/bin:/bin PYTHONPATH="$module" /usr/bin/python3 -c '
import retarget
assert abs(retarget.gli([[-1, 0, 0], [1, 0, 0]], [[0, -1, 1], [0, 1, 1]])) > 0.1
print("python", retarget.__version__, retarget.__file__)' | grep "$module"
fi
bash -n "$root/usr/share/bash-completion/completions/retarget"
hold=$root/usr/share/retarget/holds/bear_hug
cd "$work"
env -i PATH=/usr/bin:/bin "$root/usr/bin/retarget" --clip-a "$hold/a.bvh" --clip-b "$hold/b.bvh" \
  --template "$hold/template.yaml" --frames 0:60 --out out | tail -1 | grep 'every requirement is met'
# Completion offers what there is.
words=$(bash -c "source '$root/usr/share/bash-completion/completions/retarget'
  COMP_WORDS=(retarget --clip) COMP_CWORD=1; _retarget; echo \"\${COMPREPLY[@]}\"")
[[ $words == *--clip-a* && $words == *--clip-b* ]]
