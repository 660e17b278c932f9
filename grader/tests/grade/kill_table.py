"""Kills runs at random moments, and holds what comes of it against a run that nothing disturbed.

    make kill-table [KILLS=200]

A round grades a small class from nothing, then does all of it again (`--regrade all --apply`),
each time with the same command until it comes to its end, however often it is killed (`kill -9`
of the whole process group). After each kill: the database is whole, no stored result is gone or
was stored anew, grades.json and every page are complete or absent. At the end of each round: the
same grades, byte for byte, the same pages, and no other file.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import random
import re
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path

from make_class import CHECKOUT, OWNED, solution
from small_course import FOLDER, command, small_course

from raybook_grader import cli
from raybook_grader.database import Database

STUDENTS = 4
AGAIN = "#again"
_TIME = re.compile(r'(?<="at": ")[^"]*')
RULES = """
time_zone = "Europe/Zurich"
counts = "best"
[late]
percent_per_day = 10
[deadlines]
01 = 2026-10-01T12:00:00
"""
PHASES = (
    "before the folder", "planning", "grading", "publishing", "writing",
    "planning again", "grading again", "writing again", "with nothing left",
)  # fmt: skip


@dataclass
class Table:
    """What was killed where; a fault ends it all."""

    kills: Counter[str] = field(default_factory=Counter)
    rounds: int = 0

    @property
    def total(self) -> int:
        return sum(self.kills.values())

    def __str__(self) -> str:
        lines = [f"{'killed while':<20} kills  resumed, same grades"]
        for phase in PHASES:
            lines.append(f"{phase:<20} {self.kills[phase]:5}  {self.kills[phase]:5}")
        lines.append(f"{self.total} of {self.total}, in {self.rounds} rounds")
        return "\n".join(lines)


def make_course(root: Path) -> Path:
    """The small course with only its first checks: a module takes a fraction of a second."""
    small_course(root)
    rubric = root / FOLDER / "assignment.toml"
    head, *checks = rubric.read_text(encoding="utf-8").split("[[check]]")
    head = re.sub(r"(?m)^points = .*", "points = 3", head)
    rubric.write_text(head + "".join(f"[[check]]{check}" for check in checks[:3]))
    # Nothing for the diagnosis to learn.
    (root / FOLDER / "mistakes").rename(root / "mistakes")
    return root


def make_submissions(folder: Path) -> Path:
    """Students with two versions each: half of them right, half of them half done."""
    right = solution()
    texts = {True: right, False: f"#define TODO_triangle_intersect\n{right}"}
    for i in range(STUDENTS):
        for day, first in ((1, True), (3, False)):
            file = folder / f"s{i}--2026-10-0{day}T11:00:00" / OWNED
            file.parent.mkdir(parents=True)
            file.write_text(texts[first == bool(i % 2)] + f"/* {i} {day} */\n", encoding="utf-8")
    (folder / "course.toml").write_text(RULES)
    return folder


@dataclass(frozen=True)
class Place:
    """Where a round works, and its two commands."""

    course: Path
    submissions: Path
    out: Path

    @property
    def first(self) -> list[str]:
        fixed = ["grade", self.submissions, "--out", self.out, "--course", self.course]
        return [*map(str, fixed), "--jobs", "1"]

    @property
    def again(self) -> list[str]:
        return [*self.first, "--regrade", "all", "--apply"]


@dataclass(frozen=True)
class Found:
    """What lies in the output folder: the stored work by key, and the files without times."""

    work: dict[str, int]
    published: bool
    files: dict[str, str]


def look(out: Path) -> Found:
    """Look into an output folder that nobody is using; a fault if anything in it is half."""
    work: dict[str, int] = {}
    published = False
    if (out / "grades.sqlite").is_file():
        with closing(sqlite3.connect(out / "grades.sqlite")) as database:
            assert database.execute("PRAGMA integrity_check").fetchone() == ("ok",)
            if database.execute("SELECT 1 FROM sqlite_master").fetchone():
                work = dict(database.execute("SELECT key, rowid FROM work").fetchall())
                published = bool(database.execute("SELECT published FROM about").fetchone()[0])
    files = {
        str(file.relative_to(out)): _TIME.sub("", file.read_text(encoding="utf-8"))
        for file in sorted(out.rglob("*"))
        if file.is_file() and file.suffix in (".json", ".html", ".part")
    }
    for name, text in files.items():
        if name.endswith(".html"):
            assert text.rstrip().endswith("</html>"), f"{name} is not whole"
        if name.endswith(".json"):
            json.loads(text)
    return Found(work, published, files)


def decide(out: Path) -> None:
    """A decision by hand, which everything after it has to keep."""
    with closing(Database(out)) as database:
        database.decide("s0", "01", 2.5, "by hand", "the table")


def undisturbed(place: Place) -> tuple[Found, Found, float]:
    """The two results to expect, from the real command; and how long a fork of it takes."""
    done = subprocess.run(command(*place.first), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr + told_of_faults(place.first)
    first = look(place.out)
    assert len(first.work) == 2 * STUDENTS and first.published
    decide(place.out)
    begun = time.monotonic()
    finish(place.again)
    return first, look(place.out), time.monotonic() - begun


def stored(out: Path) -> int:
    """How many results are stored, while a run is storing them."""
    try:
        with closing(sqlite3.connect(f"file:{out / 'grades.sqlite'}?mode=ro", uri=True)) as db:
            return int(db.execute("SELECT count(*) FROM work").fetchone()[0])
    except sqlite3.Error:
        return 0


def start(arguments: list[str]) -> int:
    """Start the command in a session of its own; its process. It and its workers are forks of this
    process, where Python has read all modules: reading them takes longer than all the rest.
    """
    process = os.fork()
    if process:
        return process
    code = 1
    try:
        os.setsid()
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        sys.argv = ["raybook-grader", *arguments]
        fork = multiprocessing.get_context("fork")
        multiprocessing.get_context = lambda method=None: fork  # type: ignore[assignment]
        code = cli.main()
    finally:
        os._exit(code)


def finish(arguments: list[str]) -> None:
    """The command to its end."""
    _, status = os.waitpid(start(arguments), 0)
    assert status == 0, f"the run ended with status {status}{told_of_faults(arguments)}"


def told_of_faults(arguments: list[str]) -> str:
    """What the grader says of its own faults in an output folder."""
    out = Path(arguments[arguments.index("--out") + 1])
    if not (out / "grades.sqlite").is_file():
        return ""
    with closing(sqlite3.connect(out / "grades.sqlite")) as database:
        rows = database.execute("SELECT result FROM work WHERE final = 0").fetchall()
    return "".join(f"\n{json.loads(text).get('traceback')}" for (text,) in rows)


def killed(arguments: list[str], out: Path, source: random.Random, seconds: float) -> bool:
    """Start a run and kill it at a random moment; False if it came to its end before."""
    # Counted from its start, from its taking the folder, from some result, or from the last one:
    # planning and writing are so short that moments of the clock alone would miss them.
    here = stored(out)
    whole = 2 * STUDENTS * (2 if "--regrade" in arguments else 1)
    triggers = ["start", "folder", "result", "result", "last"] if here < whole else ["folder"]
    trigger = source.choice(triggers)
    wanted = whole if trigger == "last" else source.randint(min(here + 1, whole), whole)
    longest = {"start": 1, "folder": 0.05, "result": 0.1, "last": 0.05}[trigger]
    delay = source.random() * seconds * longest
    lock = out / ".lock"
    before = lock.stat().st_mtime_ns if lock.exists() else 0
    process = start(arguments)
    while not ended(process):
        now = stored(out) if trigger in ("result", "last") else 0
        if (
            trigger == "start"
            or (trigger == "folder" and lock.exists() and lock.stat().st_mtime_ns != before)
            or (trigger in ("result", "last") and now >= wanted)
        ):
            time.sleep(delay)
            break
        time.sleep(0.01)
    if not ended(process):
        try:
            os.killpg(process, signal.SIGKILL)
        except ProcessLookupError:  # it has no session of its own yet
            os.kill(process, signal.SIGKILL)
    _, status = os.waitpid(process, 0)
    assert status in (0, signal.SIGKILL), f"the run ended with status {status}"
    wait_for_the_end(process)
    return status != 0


def ended(process: int) -> bool:
    """Whether a child has come to its end; it stays to be waited for."""
    found = os.waitid(os.P_PID, process, os.WEXITED | os.WNOHANG | os.WNOWAIT)
    return found is not None


def wait_for_the_end(leader: int) -> None:
    """Until no process of the session is left; a fault if one stays."""
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        sessions = []
        for stat in Path("/proc").glob("[0-9]*/stat"):
            try:
                fields = stat.read_text().rpartition(")")[2].split()
            except OSError:
                continue
            if fields[0] != "Z":
                sessions.append(int(fields[3]))
        if leader not in sessions:
            return
        time.sleep(0.02)
    raise AssertionError("a process outlives the run")


def phase(found: Found, wholes: Sequence[Found], is_again: bool) -> str:
    """What the run was about when it was killed, by what it has left."""
    if any(key.endswith(AGAIN) for key in found.work):
        return "grading again"
    if found.files == wholes[is_again].files:
        return "with nothing left"
    if is_again:
        return "planning again" if found.files == wholes[0].files else "writing again"
    if len(found.work) < len(wholes[0].work):
        return "grading" if found.work else "planning"
    return "writing" if found.published else "publishing"


def check(before: Found, after: Found, wholes: Sequence[Found]) -> None:
    """Nothing that was stored is gone or was done anew, and what is written is one whole."""
    old = {key: number for key, number in before.work.items() if not key.endswith(AGAIN)}
    assert old.keys() <= after.work.keys(), "a result is lost"
    replaced = {key for key, number in old.items() if after.work[key] != number}
    # Only publishing puts results in the place of others, and then all of them at once.
    assert not replaced or replaced == old.keys(), "a result was done anew"
    if not replaced:
        kept = {key: after.work.get(key) for key in before.work}
        assert kept == before.work, "a result is lost or was done anew"
    grades = after.files.get("grades.json")
    assert grades is None or any(grades == whole.files["grades.json"] for whole in wholes)


def difference(found: Mapping[str, str], meant: Mapping[str, str]) -> str:
    """Other grades or pages: which files, and where the first that is in both begins to differ."""
    words = [f"only in one: {sorted(found.keys() ^ meant.keys())}"]
    for name in sorted(found.keys() & meant.keys()):
        a, b = found[name], meant[name]
        if a != b:
            at = next((i for i, (x, y) in enumerate(zip(a, b, strict=False)) if x != y), 0)
            words.append(f"{name}: {a[max(0, at - 80) : at + 80]!r} for {b[at : at + 80]!r}")
    return "\n".join(words)


def run_round(
    place: Place, wholes: tuple[Found, Found], table: Table, kills: int, source: random.Random,
    seconds: float,
) -> None:  # fmt: skip
    """One class from nothing to its end, twice graded, killed until there were enough kills."""
    for is_again, whole in enumerate(wholes):
        arguments = place.again if is_again else place.first
        if is_again:
            decide(place.out)
        before = look(place.out) if place.out.exists() else Found({}, False, {})
        while table.total < kills and killed(arguments, place.out, source, seconds):
            if not place.out.exists():
                table.kills["before the folder"] += 1
                continue
            after = look(place.out)
            check(before, after, wholes)
            table.kills[phase(after, wholes, bool(is_again))] += 1
            before = after
        finish(arguments)
        after = look(place.out)
        assert set(after.work) == set(whole.work), "results are missing, or there are too many"
        assert after.files == whole.files, difference(after.files, whole.files)
    table.rounds += 1


def make_table(folder: Path, kills: int, seed: int) -> Table:
    """Kill so many runs; AssertionError at the first that does not come out right."""
    course = make_course(folder / "course")
    submissions = make_submissions(folder / "class")
    first, second, seconds = undisturbed(Place(course, submissions, folder / "whole"))
    table = Table()
    source = random.Random(seed)
    while table.total < kills:
        place = Place(course, submissions, folder / f"out{table.rounds}")
        run_round(place, (first, second), table, kills, source, seconds)
        print(f"round {table.rounds}: {table.total} kills", file=sys.stderr, flush=True)
    return table


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description="Kills runs of the grader at random moments.")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    begun = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        table = make_table(Path(folder), arguments.kills, arguments.seed)
    print(table)
    print(f"{time.monotonic() - begun:.0f} s, seed {arguments.seed}, from {CHECKOUT.name}/")
    return 0


if __name__ == "__main__":
    sys.exit(main())
