# shellcheck shell=bash
# Part of setup.sh: build/venv with the packages of requirements.lock and the grader (editable); in
# the student edition, which has no grader/, with the few packages of student.lock.
# shellcheck disable=SC2154 # here, root and work are setup.sh's

venv=${RAYBOOK_VENV:-$root/build/venv}
has_grader() { [ -d "$root/grader" ]; }
lock() { if has_grader; then echo "$here/requirements.lock"; else echo "$here/student.lock"; fi; }

# What build/venv was made of, kept in stamps that are written last: an interrupted run, a moved
# checkout, another Python or another lock makes it stale.
venv_key() { echo "$root"; "$venv/bin/python" -V 2>&1; cat "$(lock)"; }
grader_key() { cat "$root/grader/pyproject.toml"; }

venv_ready() { [ -x "$venv/bin/python" ] && venv_key | cmp -s - "$venv/lock.stamp"; }
grader_ready() { ! has_grader || grader_key | cmp -s - "$venv/grader.stamp"; }

# Another's environment is used as it is.
python_ready() {
    if [ -n "${RAYBOOK_VENV:-}" ]; then [ -x "$venv/bin/python" ]; else venv_ready && grader_ready; fi
}

# The first Python that the lock has packages for and that can make an environment.
find_python() {
    local python candidates=("${PYTHON:-python3}")
    [ -n "${PYTHON:-}" ] || candidates+=(/usr/bin/python3)
    for python in "${candidates[@]}"; do
        if "$python" -c 'import ensurepip, sys, venv
sys.exit(not (3, 11) <= sys.version_info < (3, 14))' 2>/dev/null; then
            echo "$python"
            return
        fi
    done
    die 'Python 3.11, 3.12 or 3.13 with its venv module is needed,' \
        "but ${candidates[0]} is $("${candidates[0]}" -V 2>&1 | tail -n 1)" \
        'another one can be named: make setup PYTHON=/path/to/python3'
}

pip_install() {
    logged "$1" "$venv/bin/python" -m pip --disable-pip-version-check install --no-input "${@:2}" ||
        die 'pip could not install the Python packages; the next run tries again'
}

setup_python() {
    local python size='250 MB, half a minute'
    [ -z "${RAYBOOK_VENV:-}" ] || die "RAYBOOK_VENV=$RAYBOOK_VENV has no bin/python"
    ! has_grader || size='700 MB, about a minute'
    if ! venv_ready; then
        python=$(find_python)
        say "Python packages into build/venv ($size)"
        rm -f "$venv"/*.stamp
        logged venv "$python" -m venv --clear "$venv" || die "$python could not make $venv"
        # Wheels only: nothing is compiled here, and no package runs code while it is installed.
        pip_install pip --only-binary :all: --require-hashes -r "$(lock)"
        venv_key >"$venv/lock.stamp"
    fi
    has_grader || return 0
    pip_install pip-grader --no-deps --no-build-isolation -e "$root/grader"
    grader_key >"$venv/grader.stamp"
}
