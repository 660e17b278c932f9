#!/usr/bin/env bash
# compare.py in an environment of its own (environment.sh).
#
#   compare.sh [--raybook build/raybook] [--spp 1024] [scene.json ...]    compare.py's arguments
#
# Mitsuba compiles its kernels with LLVM, 17 or newer, which it finds as a shared library:
# DRJIT_LIBLLVM_PATH, or where Debian and its kin install it. Exit code: 2 if there is none.
# Environment: PYTHON   the interpreter to make the environment from (3.11 to 3.13)
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)

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
"$here/environment.sh"
export PYTHONPATH=$root/grader
exec "$root/build/mitsuba-venv/bin/python" "$here/compare.py" "$@"
