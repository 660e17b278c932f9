#!/usr/bin/env bash
# The environment that Mitsuba runs in, build/mitsuba-venv, with the packages of requirements.lock:
# it is too large to be put into everybody's build/venv.
#
#   environment.sh [--installed]     makes it unless it is there; --installed: fails if it is not
#
# Exit code: 0 it is there, 1 it is not.
# Environment: PYTHON   the interpreter to make the environment from (3.11 to 3.13)
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)
venv=$root/build/mitsuba-venv

key() { echo "$root"; cat "$here/requirements.lock"; }

make_venv() {
    local python=${PYTHON:-$root/build/venv/bin/python}
    echo "Mitsuba and its kin into build/mitsuba-venv (500 MB)" >&2
    rm -f "$venv/lock.stamp"
    "$python" -m venv --clear "$venv"
    "$venv/bin/python" -m pip --disable-pip-version-check install --quiet --no-input \
        --only-binary :all: --require-hashes -r "$here/requirements.lock"
    key >"$venv/lock.stamp"
}

if ! key | cmp -s - "$venv/lock.stamp" 2>/dev/null; then
    if [ "${1:-}" = --installed ]; then
        echo "Mitsuba is not installed: make mitsuba, or make bench without QUICK=1" >&2
        exit 1
    fi
    make_venv
fi
