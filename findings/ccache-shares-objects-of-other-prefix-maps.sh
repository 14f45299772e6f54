#!/usr/bin/env bash
# Finding: ccache hands out an object that was compiled with another -fmacro-prefix-map.
#
# Guess: a flag that changes bytes of the object is part of ccache's hash, so that two values make two objects.
# Seen (ccache 4.7.5, GCC 12): the second compilation, with another value of -fmacro-prefix-map, is a hit, and the object has
# the first one's __FILE__. Whoever maps the source folder away so that checkouts share objects gains by it; whoever builds
# two products from one tree with different maps gets the wrong one's names in messages.
#
# Needs a Debian 12 with apt and its gcc. Fails when ccache tells the two apart.
set -euo pipefail
version=4.8+really4.7.5-1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/debs/partial" "$work/root" "$work/source"
: >"$work/status"
apt-get -qq -y --no-install-recommends --download-only -o Dir::State::status="$work/status" \
    -o Dir::Cache::archives="$work/debs" -o Debug::NoLocking=1 -o APT::Sandbox::User=root install "ccache=$version" >/dev/null
for deb in "$work"/debs/*.deb; do
    case ${deb##*/} in libc6_* | libgcc-s1_* | libstdc++6_*) ;; *) dpkg-deb -x "$deb" "$work/root" ;; esac
done
echo 'const char* file(void) { return __FILE__; }' >"$work/source/x.c"
export CCACHE_DIR=$work/cache CCACHE_CONFIGPATH=/dev/null LD_LIBRARY_PATH=$work/root/usr/lib/x86_64-linux-gnu
ccache=$work/root/usr/bin/ccache
named() { # named MAP: the file's name in an object that was compiled with that map
    "$ccache" gcc -c "$work/source/x.c" "-fmacro-prefix-map=$work/source/=$1/" -o "$work/$1.o"
    grep -ao '[a-z]*/x\.c' "$work/$1.o" | head -n 1
}
"$ccache" --version | head -n 1
first=$(named one)
second=$(named two)
gcc -c "$work/source/x.c" "-fmacro-prefix-map=$work/source/=two/" -o "$work/plain.o"
plain=$(grep -ao '[a-z]*/x\.c' "$work/plain.o" | head -n 1)
printf '%-34s %s\n' "map to one/, through ccache" "$first" "map to two/, through ccache" "$second" "map to two/, gcc alone" "$plain"
[[ $first == one/x.c && $plain == two/x.c ]] || { echo "changed: gcc does not map as before"; exit 1; }
[[ $second == one/x.c ]] || { echo "changed: ccache tells the maps apart"; exit 1; }
echo "as found: the second object has the first one's name"
