"""`.setup/setup.sh` and its lists: quiet when nothing is missing, clear when something is.

Most tests run a copy of `.setup/` with made-up system tools first in PATH, so that they neither
need root nor change this machine, and the same happens on any system.
"""

import json
import os
import re
import shutil
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SETUP = ROOT / ".setup"

FAKES = {
    # Knows every package; not installed are the names in `missing`.
    "dpkg-query": """
        for name in "${@:4}"; do
            grep -qx "$name" "$STATE/missing" || echo "installed $name"
        done""",
    # Installs, save what `refused` names; notes each call.
    "apt-get": """
        echo "$*" >>"$STATE/apt-calls"
        if grep -qxFf "$STATE/refused" <(printf '%s\\n' "$@"); then
            echo 'E: no such package'
            exit 100
        fi
        left=$(grep -vxFf <(printf '%s\\n' "$@") "$STATE/missing")
        echo "$left" >"$STATE/missing" """,
    "id": 'cat "$STATE/uid"',
    "sudo": "exit 1",
    # Makes an "environment" whose pip fails as long as `pip-fails` exists.
    "python": """
        case $1 in
            -c) exit "$(cat "$STATE/python-too-old")" ;;
            -V) echo Python 3.0.1 ;;
            -m) if [ "$2" = venv ]; then mkdir -p "${@: -1}/bin" && cp "$0" "${@: -1}/bin/python"
                elif [ -e "$STATE/pip-fails" ]; then echo hash mismatch; exit 1
                fi ;;
        esac""",
}


@dataclass(frozen=True)
class Machine:
    """A checkout with only `.setup/`, on a made-up machine whose state is files in `state`."""

    checkout: Path
    state: Path
    path: str

    def write(self, name: str, lines: Iterable[str] = ()) -> None:
        """Sets the state file `name` to `lines`."""
        (self.state / name).write_text("".join(f"{line}\n" for line in lines))

    def setup(self, *parts: str, **env: str) -> subprocess.CompletedProcess[str]:
        """Runs setup.sh without a terminal."""
        return subprocess.run(
            [self.checkout / ".setup/setup.sh", *parts],
            env={"PATH": self.path, "STATE": str(self.state), "HOME": "/nonexistent", **env},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
        )


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    """Nobody's machine, without sudo, where all packages are installed."""
    tools = tmp_path / "tools"
    tools.mkdir()
    for name, body in FAKES.items():
        (tools / name).write_text(f"#!/usr/bin/env bash\n{body}\n")
        (tools / name).chmod(0o755)
    shutil.copytree(SETUP, tmp_path / "checkout/.setup")
    (tmp_path / "state").mkdir()
    made = Machine(tmp_path / "checkout", tmp_path / "state", f"{tools}:{os.environ['PATH']}")
    for name in ("missing", "refused"):
        made.write(name)
    made.write("uid", ["65534"])
    made.write("python-too-old", ["0"])
    return made


def said(result: subprocess.CompletedProcess[str]) -> str:
    return result.stdout + result.stderr


def listed(*without: str) -> list[str]:
    """The names in packages.txt, less those marked with one of `without`."""
    words = [
        line.partition("#")[0].split() for line in (SETUP / "packages.txt").read_text().splitlines()
    ]
    return [w[0] for w in words if w and not set(w[1:]) & set(without)]


# ---- this machine ----


def test_second_run_says_nothing_and_changes_nothing() -> None:
    command = [SETUP / "setup.sh"]
    subprocess.run(command, stdin=subprocess.DEVNULL, check=True)
    stamps = [*sorted(ROOT.glob("build/venv/*.stamp")), ROOT / "build/setup"]
    before = [path.stat().st_mtime_ns for path in stamps]
    again = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, check=True)
    assert (again.stdout, again.stderr) == (b"", b"")
    assert [path.stat().st_mtime_ns for path in stamps] == before


@pytest.mark.skipif(not shutil.which("dpkg-query"), reason="not a Debian system")
@pytest.mark.parametrize("name", listed("optional", "book"))
def test_every_listed_package_exists_and_is_installed(name: str) -> None:
    query = ["dpkg-query", "-W", "-f", "${db:Status-Status}", name]
    assert subprocess.run(query, capture_output=True, text=True, check=True).stdout == "installed"


# ---- packages ----


def test_print_command_names_what_this_checkout_needs(machine: Machine) -> None:
    student = machine.setup("--print-command")
    with_grader(machine)
    instructor = machine.setup("--print-command")
    for result, names in ((student, listed("grader", "book")), (instructor, listed("book"))):
        assert result.returncode == 0
        assert result.stdout.startswith("sudo apt-get install -y ")
        assert [word for word in result.stdout.split()[4:] if word[0] != "-"] == names
    assert "bubblewrap" not in student.stdout


def test_without_root_one_command_is_printed(machine: Machine) -> None:
    with_grader(machine)
    machine.write("missing", ["unifdef", "gcc", "clangd"])
    result = machine.setup("packages")
    assert result.returncode == 1
    assert re.findall(r"\S*apt-get .*", said(result)) == [
        "apt-get install -y --no-install-recommends gcc unifdef clangd"
    ]
    assert not (machine.state / "apt-calls").exists()


def test_only_an_optional_package_missing_is_said_once(machine: Machine) -> None:
    machine.write("missing", ["libembree-dev"])
    first, second = machine.setup("packages"), machine.setup("packages")
    assert (first.returncode, second.returncode) == (0, 0)
    assert "without libembree-dev" in first.stdout
    assert said(second) == ""


def test_root_installs_what_is_missing_and_only_that(machine: Machine) -> None:
    machine.write("uid", ["0"])
    machine.write("missing", ["gcc", "clangd"])
    machine.write("refused", ["clangd"])
    first = machine.setup("packages")
    assert first.returncode == 0, said(first)
    assert "without clangd" in first.stdout
    calls = (machine.state / "apt-calls").read_text().splitlines()
    names = [{word for word in call.split() if word in listed()} for call in calls]
    assert names == [set(), {"gcc"}, {"clangd"}]  # apt-get update first
    assert said(machine.setup("packages")) == ""


def test_apt_failure_stops_with_the_tail_of_its_output(machine: Machine) -> None:
    machine.write("uid", ["0"])
    machine.write("missing", ["gcc"])
    machine.write("refused", ["gcc"])
    result = machine.setup("packages", "unity")
    assert result.returncode == 1
    assert "E: no such package" in result.stderr
    assert "could not install: gcc" in result.stderr


def test_without_apt_the_libraries_are_checked(machine: Machine, tmp_path: Path) -> None:
    tools = tmp_path / "no-apt"
    tools.mkdir()
    for name in ("bash", "env", "dirname", "sed", "awk", "grep", "tr", "cat", "mkdir"):
        (tools / name).symlink_to(str(shutil.which(name)))
    result = machine.setup("packages", PATH=str(tools), CC="no-such-compiler")
    assert result.returncode == 1
    for name in ("no-such-compiler", "OpenEXR", "cJSON", "stb"):
        assert name in result.stderr


# ---- python ----


def test_the_student_edition_has_a_small_environment(machine: Machine, tmp_path: Path) -> None:
    unity = str(unity_in(tmp_path))
    result = machine.setup(UNITY_ROOT=unity, PYTHON="python")
    assert result.returncode == 0, said(result)
    venv = machine.checkout / "build/venv"
    assert (SETUP / "student.lock").read_text() in (venv / "lock.stamp").read_text()
    assert not (venv / "grader.stamp").exists()
    assert said(machine.setup(UNITY_ROOT=unity, PYTHON="python")) == ""


def test_anothers_environment_is_used_as_it_is(machine: Machine, tmp_path: Path) -> None:
    missing = machine.setup("python", RAYBOOK_VENV=str(tmp_path / "shared"))
    assert missing.returncode == 1
    assert f"RAYBOOK_VENV={tmp_path}/shared has no bin/python" in missing.stderr
    (tmp_path / "shared/bin").mkdir(parents=True)
    shutil.copy(tmp_path / "tools/python", tmp_path / "shared/bin/python")
    result = machine.setup("python", RAYBOOK_VENV=str(tmp_path / "shared"))
    assert (result.returncode, said(result)) == (0, "")


def with_grader(machine: Machine) -> Path:
    (machine.checkout / "grader").mkdir()
    shutil.copy(ROOT / "grader/pyproject.toml", machine.checkout / "grader")
    return machine.checkout / "build/venv"


def test_interrupted_environment_is_made_again(machine: Machine) -> None:
    venv = with_grader(machine)
    machine.write("pip-fails")
    failed = machine.setup("python", PYTHON="python")
    assert failed.returncode == 1
    assert "hash mismatch" in failed.stderr
    assert not list(venv.glob("*.stamp"))

    (machine.state / "pip-fails").unlink()
    assert machine.setup("python", PYTHON="python").returncode == 0
    again = machine.setup("python", PYTHON="python")
    assert (again.returncode, said(again)) == (0, "")


@pytest.mark.parametrize("file", [".setup/requirements.lock", "grader/pyproject.toml"])
def test_environment_follows_what_it_was_made_of(machine: Machine, file: str) -> None:
    with_grader(machine)
    machine.setup("python", PYTHON="python")
    with (machine.checkout / file).open("a") as changed:
        changed.write("\n# changed\n")
    machine.write("pip-fails")
    assert machine.setup("python", PYTHON="python").returncode == 1


def test_python_too_old_is_named(machine: Machine) -> None:
    venv = with_grader(machine)
    machine.write("python-too-old", ["1"])
    result = machine.setup("python", PYTHON="python")
    assert result.returncode == 1
    assert "Python 3.0.1" in result.stderr
    assert not venv.exists()


# ---- book ----


def with_npm(machine: Machine, tmp_path: Path) -> None:
    """A node, a qpdf, and an npm that fails as long as `npm-fails` exists."""
    npm = '[ ! -e "$STATE/npm-fails" ] && mkdir "$2/node_modules" || { echo wrong hash; exit 1; }'
    for name, body in (("node", "exit 1"), ("npm", npm), ("qpdf", "exit 1")):
        (tmp_path / "tools" / name).write_text(f"#!/usr/bin/env bash\n{body}\n")
        (tmp_path / "tools" / name).chmod(0o755)


def test_the_book_is_set_up_when_it_is_asked_for(machine: Machine, tmp_path: Path) -> None:
    with_npm(machine, tmp_path)
    machine.write("npm-fails")
    failed = machine.setup("book")
    assert failed.returncode == 1 and "wrong hash" in failed.stderr
    (machine.state / "npm-fails").unlink()
    assert "KaTeX" in machine.setup("book").stdout
    assert said(machine.setup("book")) == ""
    with (machine.checkout / ".setup/book/package-lock.json").open("a") as changed:
        changed.write("\n")
    assert "KaTeX" in machine.setup("book").stdout, "another lock, other packages"


def test_what_the_book_needs_is_pinned_and_names_no_host() -> None:
    text = (SETUP / "book/package-lock.json").read_text()
    packages = json.loads(text)["packages"]
    assert all("integrity" in entry for name, entry in packages.items() if name)
    assert "://" not in text


# ---- unity ----


def unity_in(folder: Path) -> Path:
    for name in ("unity.c", "unity.h", "unity_internals.h"):
        (folder / name).touch()
    return folder


def test_unity_root_without_unity_is_refused(machine: Machine, tmp_path: Path) -> None:
    result = machine.setup("unity", UNITY_ROOT=str(tmp_path))
    assert result.returncode == 1
    assert f"UNITY_ROOT={tmp_path}" in result.stderr
    assert not (machine.state / "apt-calls").exists()


UNITY_TEST = """\
#include "unity.h"
void setUp(void) {}
void tearDown(void) {}
static void test_double(void) { TEST_ASSERT_EQUAL_DOUBLE(0.1 + 0.2, EXPECTED); }
int main(void) { UNITY_BEGIN(); RUN_TEST(test_double); return UNITY_END(); }
"""


@pytest.mark.parametrize(("expected", "failures"), [("0.3", 0), ("0.4", 1)])
def test_unity_compiles_as_strict_c99_and_judges(
    tmp_path: Path, expected: str, failures: int
) -> None:
    unity = Path(os.environ.get("UNITY_ROOT") or ROOT / "build/unity")
    (tmp_path / "test.c").write_text(UNITY_TEST)
    flags = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-DUNITY_INCLUDE_DOUBLE"]
    files = [f"-I{unity}", f"{unity}/unity.c", f"{tmp_path}/test.c", "-o", f"{tmp_path}/test"]
    subprocess.run(["gcc", *flags, f"-DEXPECTED={expected}", *files], check=True)
    assert subprocess.run([tmp_path / "test"], check=False).returncode == failures


SOURCES = """\
# Debian
Types: deb
# an old mirror
URIs: http://mirror.test/debian
Suites: bookworm bookworm-updates
Components: main
Signed-By: /usr/share/keyrings/debian.gpg

Types: deb
URIs: http://elsewhere.test
Suites: nodistro
Components: main
"""


def derived_sources(tmp_path: Path, suite: str) -> str:
    """What apt would read for `suite` on a machine with sources of both formats."""
    (tmp_path / "etc/sources.list.d").mkdir(parents=True)
    (tmp_path / "etc/sources.list").write_text(
        "# deb http://old.test bookworm main\n"
        "deb [arch=amd64] http://list.test/debian bookworm main contrib\n"
        "deb http://cloud.test sdk-bookworm main\n"
    )
    (tmp_path / "etc/sources.list.d/debian.sources").write_text(SOURCES)
    script = f'source "{SETUP}/unity.sh"; source_lists {suite} "$work/etc"'
    subprocess.run(
        ["bash", "-euc", script], env={**os.environ, "root": "", "work": str(tmp_path)}, check=True
    )
    made = sorted((tmp_path / "apt/sources").iterdir())
    return "\n".join(path.read_text() for path in made)


def test_source_lists_keep_to_the_release(tmp_path: Path) -> None:
    text = derived_sources(tmp_path, "bookworm")
    assert "deb-src [arch=amd64] http://list.test/debian bookworm main contrib\n" in text
    assert "Types: deb-src\nURIs: http://mirror.test/debian\nSuites: bookworm\n" in text
    assert "Signed-By: /usr/share/keyrings/debian.gpg" in text
    assert not re.search(r"cloud|elsewhere|old\.test|^(Types: )?deb$|^deb ", text, re.MULTILINE)


def test_source_lists_of_an_unknown_release_are_all(tmp_path: Path) -> None:
    text = derived_sources(tmp_path, "sid")
    for host in ("list", "cloud", "mirror", "elsewhere"):
        assert f"//{host}.test" in text


# ---- the lock ----


def normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


LOCKS = ["requirements", "student"]


def lines_of(name: str) -> list[str]:
    """The entries of a lock, each in one line, without its comments."""
    text = re.sub(r"^ *#.*\n", "", (SETUP / f"{name}.lock").read_text(), flags=re.MULTILINE)
    return re.sub(r"\\\n", " ", text).splitlines()


def wanted(name: str) -> set[str]:
    """The packages that an .in file asks for, also by way of another."""
    text = (SETUP / f"{name}.in").read_text()
    names = {normal(found) for found in re.findall(r"^\w[\w.-]*", text, re.MULTILINE)}
    for other in re.findall(r"^-r (\w+)\.in", text, re.MULTILINE):
        names |= wanted(other)
    return names


@pytest.mark.parametrize("name", LOCKS)
def test_lock_pins_and_hashes_every_package(name: str) -> None:
    hashed = re.compile(r"[\w.-]+==[\w.]+( ; [^=]+[=<>!]=?[^=]+)? +(--hash=sha256:[0-9a-f]{64} *)+")
    for entry in lines_of(name):
        assert hashed.fullmatch(re.sub(" +", " ", entry)), entry
    pinned = {normal(entry.partition("==")[0]) for entry in lines_of(name)}
    assert wanted(name) <= pinned


def test_student_lock_is_part_of_the_whole() -> None:
    assert set(lines_of("student")) < set(lines_of("requirements"))


@pytest.mark.parametrize("name", LOCKS)
def test_lock_names_no_index_and_no_path(name: str) -> None:
    text = (SETUP / f"{name}.lock").read_text()
    assert not re.search(r"://|--(extra-)?index-url|--find-links|(^|\s)/|file:", text)
