#!/usr/bin/env bash
# Gradescope runs this once, as root, when it builds the autograder's image: it installs the
# packages, builds the reference, and grades the course's own solution, which renders what
# submissions are compared with. So an autograder that cannot work is told of now.
#
# Environment: RAYBOOK_VENV  a Python environment that has the packages already
set -euo pipefail

source=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$source/raybook"

stop() { printf 'setup.sh: %s\n' "$@" >&2; exit 1; }

. /etc/os-release
case ${ID:-}-${VERSION_ID:-} in
    debian-8 | debian-9 | debian-1[01] | ubuntu-1* | ubuntu-2[0-3].*)
        stop "${PRETTY_NAME:-this system} is too old: Python 3.11 and OpenEXR 3.1 are needed." \
            'Choose Ubuntu 24.04 or newer as the base image (Configure Autograder).' ;;
esac

.setup/setup.sh packages python

# The image is built on one machine and runs on others: nothing of this one's processor.
case $(uname -m) in
    x86_64) arch=x86-64 ;;
    aarch64) arch=armv8-a ;;
    *) arch=native ;;
esac
make kit ARCH="$arch"
rm -rf build/obj

export PYTHONPATH=$PWD/grader
"${RAYBOOK_VENV:-$PWD/build/venv}/bin/python" -m raybook_grader.gradescope.run \
    "$(dirname "$source")" --check ||
    stop "the course's own solution cannot be graded here; the reason is above." \
        'If no sandbox can be made in this container, and you accept that students'"'"' programs' \
        'can then read the autograder: raybook-grader gradescope-bundle --unsafe'
