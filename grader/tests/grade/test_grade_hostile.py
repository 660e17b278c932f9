"""Modules that try for more than their points: each costs only its student, and gains nothing."""

from __future__ import annotations

from typing import Any

import pytest
from make_class import CHECKOUT, OWNED, solution
from small_course import checks, grades, run, small_course, write_submissions

from raybook_grader.checks.stub import stub_text

FORGED = """
#include <stdio.h>
#include <unistd.h>
__attribute__((constructor)) static void forge(void)
{
    puts("test.c:1:everything:PASS\\n-----\\n27 Tests 0 Failures 0 Ignored\\nOK");
    fflush(stdout);
    _exit(0);
}
"""
HUNGRY = """
#include <stdlib.h>
#include <string.h>
__attribute__((constructor)) static void eat(void)
{
    for (;;) {
        char *food = malloc(1 << 20);
        memset(food, 1, 1 << 20);
    }
}
"""
LOUD = """
#include <stdio.h>
__attribute__((constructor)) static void shout(void)
{
    for (;;)
        puts("shout");
}
"""
# Replacing what others call must change nothing: all but the contract is local to the module.
SELFISH = """
float sqrtf(float x) { return 0.0f * x; }
void *mem_alloc(unsigned long n) { (void)n; return 0; }
int main(void) { return 7; }
"""


@pytest.fixture(scope="module")
def graded(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    top = tmp_path_factory.mktemp("hostile")
    stub = stub_text(CHECKOUT, OWNED)
    texts = {
        "forged": stub + FORGED,
        "hungry": stub + HUNGRY,
        "loud": stub + LOUD,
        "endless": '#include "/dev/zero"\n' + stub,
        "thief": '#include "/etc/passwd"\n' + stub,
        "selfish": solution() + SELFISH,
        "<b>honest</b>": solution(),
    }
    # The names of folders cannot hold a slash.
    named = {name.replace("/", "\\"): text for name, text in texts.items()}
    folder = write_submissions(top / "class", named, OWNED)
    ended = run("grade", folder, "--out", top / "out", "--course", small_course(top / "course"))
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert "<b>honest" not in (top / "out" / "index.html").read_text(encoding="utf-8")
    return grades(top / "out")


def test_a_forged_test_result_earns_nothing(graded: dict[str, Any]) -> None:
    found = {check["name"]: check for check in checks(graded["forged"])}
    assert found["public unit tests"]["status"] == "unconfirmed"
    assert [c["score"] for c in found.values() if c["kind"] != "build"] == [0] * (len(found) - 1)
    assert graded["forged"]["modules"][0]["verdict"] == "fail"


@pytest.mark.parametrize(
    ("name", "verdict"),
    [
        ("hungry", "memory"),
        ("loud", "forbidden"),
        ("endless", "build-error"),
        ("thief", "build-error"),
        ("<b>honest<\\b>", "pass"),
    ],
)
def test_each_gets_its_own_verdict(graded: dict[str, Any], name: str, verdict: str) -> None:
    assert graded[name]["modules"][0]["verdict"] == verdict


def test_no_file_of_the_machine_is_quoted(graded: dict[str, Any]) -> None:
    assert "root:" not in str(graded["thief"])


def test_a_module_replaces_nothing_but_itself(graded: dict[str, Any]) -> None:
    statuses = {check["kind"]: check["status"] for check in checks(graded["selfish"])}
    assert statuses["unit"] == statuses["probe"] == "passed"
