# Shared by the scripts in this folder, which source it: where the tree is, how they speak, how they log.
# shellcheck shell=bash

# Every script works on its own tree, from whatever folder it was called.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# /build*/ is ignored by git, so a log there never shows up as a change.
log_dir=$root/build/log

say() { printf '== %s\n' "$*"; }
die() {
    printf '%s: %s\n' "$(basename "$0")" "$*" >&2
    exit 1
}
usage_error() {
    printf '%s: %s (see --help)\n' "$(basename "$0")" "$*" >&2
    exit 2
}

# logged NAME COMMAND...: runs COMMAND with its output on the terminal, as it comes, and in a log file as well.
# Long work must be seen to move, and a failure must still be there to read once the terminal has scrolled.
logged() {
    local log=$log_dir/$1.log
    shift
    mkdir -p "$log_dir"
    "$@" 2>&1 | tee "$log" || die "failed: $*; the whole output is in ${log#"$PWD"/}"
}
