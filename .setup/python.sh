# shellcheck shell=bash
# Part of setup.sh: build/venv with the packages of requirements.lock and the grader (editable).
# Nothing to do where there is no grader/, as in the student edition.
# shellcheck disable=SC2154 # here, root and work are setup.sh's

venv=$root/build/venv

# What build/venv was made of, kept in stamps that are written last: an interrupted run, a moved
# checkout, another Python or another lock makes it stale.
venv_key() { echo "$root"; "$venv/bin/python" -V 2>&1; cat "$here/requirements.lock"; }
grader_key() { cat "$root/grader/pyproject.toml"; }

venv_ready() { [ -x "$venv/bin/python" ] && venv_key | cmp -s - "$venv/lock.stamp"; }
grader_ready() { grader_key | cmp -s - "$venv/grader.stamp"; }

python_ready() { [ ! -d "$root/grader" ] || { venv_ready && grader_ready; }; }

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
    local python
    if ! venv_ready; then
        python=$(find_python)
        say 'Python packages into build/venv (500 MB, about a minute)'
        rm -f "$venv"/*.stamp
        logged venv "$python" -m venv --clear "$venv" || die "$python could not make $venv"
        # Wheels only: nothing is compiled here, and no package runs code while it is installed.
        pip_install pip --only-binary :all: --require-hashes -r "$here/requirements.lock"
        venv_key >"$venv/lock.stamp"
    fi
    pip_install pip-grader --no-deps --no-build-isolation -e "$root/grader"
    grader_key >"$venv/grader.stamp"
}
