#!/usr/bin/env bash
# compare.py in an environment of its own, build/mitsuba-venv, with the packages of
# requirements.lock: Mitsuba is too large to be put into everybody's build/venv.
#
#   compare.sh [--raybook build/raybook] [--spp 1024] [scene.json ...]    compare.py's arguments
#
# Mitsuba compiles its kernels with LLVM, 17 or newer, which it finds as a shared library:
# DRJIT_LIBLLVM_PATH, or where Debian and its kin install it. Exit code: 2 if there is none.
# Environment: PYTHON   the interpreter to make the environment from (3.11 to 3.13)
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)
venv=$root/build/mitsuba-venv

key() { echo "$root"; cat "$here/requirements.lock"; }

make_venv() {
    local python=${PYTHON:-$root/build/venv/bin/python}
    echo "Mitsuba and its kin into build/mitsuba-venv (500 MB)"
    rm -f "$venv/lock.stamp"
    "$python" -m venv --clear "$venv"
    "$venv/bin/python" -m pip --disable-pip-version-check install --quiet --no-input \
        --only-binary :all: --require-hashes -r "$here/requirements.lock"
    key >"$venv/lock.stamp"
}

# The newest library of LLVM 17 or later, by the name that Debian's packages give it.
find_llvm() {
    local version path
    for version in $(seq 30 -1 17); do
        for path in /usr/lib/*/libLLVM.so."$version".* /usr/lib/*/libLLVM-"$version".so* \
            /usr/lib/llvm-"$version"/lib/libLLVM*.so*; do
            if [ -e "$path" ]; then
                echo "$path"
                return
            fi
        done
    done
}

if [ -z "${DRJIT_LIBLLVM_PATH:-}" ]; then
    DRJIT_LIBLLVM_PATH=$(find_llvm)
    [ -n "$DRJIT_LIBLLVM_PATH" ] || {
        echo "compare.sh: no LLVM 17 or newer: apt-get install libllvm19 (or any libllvm17 and" >&2
        echo "later of your system), or set DRJIT_LIBLLVM_PATH to its libLLVM.so" >&2
        exit 2
    }
fi
export DRJIT_LIBLLVM_PATH
key | cmp -s - "$venv/lock.stamp" 2>/dev/null || make_venv
export PYTHONPATH=$root/grader
exec "$venv/bin/python" "$here/compare.py" "$@"
