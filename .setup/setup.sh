#!/usr/bin/env bash
# Installs what Raybook needs and is not there yet. Silent and quick when nothing is missing.
#
#   setup.sh [packages | python | unity | book ...]   these parts only; by default all but the book
#   setup.sh --print-command                         the apt-get command for every package
#
# Each part is a file beside this one with NAME_ready (is there nothing to do?) and setup_NAME.
# Nothing is asked of a person unless both ends are a terminal. Exit code: 0 all there, 1 not.
#
# Environment: PYTHON      the interpreter to make build/venv from (3.11 to 3.13)
#              RAYBOOK_VENV  an environment that has the packages already, in place of build/venv
#              UNITY_ROOT  a folder with unity.c and its headers, in place of build/unity
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(dirname "$here")
work=$root/build/setup

say() { printf 'setup: %s\n' "$*"; }
die() { printf '%s\n' "setup: $1" "${@:2}" >&2; exit 1; }
have() { command -v "$1" >/dev/null 2>&1; }

# logged NAME COMMAND...: the output goes to build/setup/NAME.log; on failure its end is shown.
logged() {
    local log=$work/$1.log
    shift
    if ! "$@" >"$log" 2>&1 </dev/null; then
        tail -n 15 "$log" >&2
        printf 'setup: all of that output: %s\n' "$log" >&2
        return 1
    fi
}

# shellcheck source-path=SCRIPTDIR
source "$here/packages.sh"
# shellcheck source-path=SCRIPTDIR
source "$here/python.sh"
# shellcheck source-path=SCRIPTDIR
source "$here/unity.sh"
# shellcheck source-path=SCRIPTDIR
source "$here/book.sh"

main() {
    local part parts=("$@") todo=()
    case ${1:-all} in
        --print-command) install_command "$(listed)"; return ;;
        all) parts=(packages python unity) ;;
    esac
    for part in "${parts[@]}"; do
        case $part in packages | python | unity | book) ;; *) die "no part '$part'; usage: see $0" ;; esac
        "${part}_ready" || todo+=("$part")
    done
    for part in "${todo[@]}"; do
        mkdir -p "$work"
        # Two makes at once: the second waits, then finds the part ready.
        if have flock; then exec 9>"$work/lock" && flock 9; fi
        "${part}_ready" || "setup_$part"
    done
}

main "$@"
