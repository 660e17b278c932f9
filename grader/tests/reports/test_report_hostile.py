"""Pages made in bad faith: nothing of theirs runs, asks for anything, or hides."""

from __future__ import annotations

from pathlib import Path

import pytest
from looking import looking
from playwright.sync_api import Browser
from report_class import CHECKOUT, assignments, module_pages, viewer, write_class

from raybook_grader.checks.reference import References
from raybook_grader.checks.result import Status, conclude
from raybook_grader.course import BuildCheck, ImageCheck, ProbeCheck
from raybook_grader.diagnosis import Diagnosis
from raybook_grader.grading.job import Worker
from raybook_grader.grading.module import ModuleGrader
from raybook_grader.grading.result import ModuleResult, from_checks, internal_error
from raybook_grader.scoring import Verdict
from raybook_grader.submissions import SubmittedFile

pytest_plugins = ("report_fixtures",)

ATTACKS = (
    "<script>alert('id')</script>",
    "<img src=x onerror=alert(1)>",
    "</style></script><svg onload=alert(2)>",
    "{{ 7 * 7 }}{% raise %}",
    '" autofocus onfocus="alert(3)" x="',
    "javascript:alert(4)",
    "--></title><iframe src='https://example.org/'></iframe>",
    "<link rel=stylesheet href=//example.org/x.css><meta http-equiv=refresh content=0;url=//x.org>",
    "\u202egpj.live\u202c \u2066hidden\u2069 zero\u200bwidth",
    "\x1b]8;;http://example.org\x07click\x1b]8;;\x07 \x1b[2J",
    "bytes \udcff\udc80 that are no UTF-8",
    "W" * 100_000,
    "Z" + "\u0335\u0336" * 500,
)


@pytest.fixture(scope="module")
def hostile(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Every text that a student can influence, in bad faith."""
    everything = " ".join(ATTACKS)
    build, probe = BuildCheck("build", 1), ProbeCheck("probe", 3, "p.c", "o.py", "edges", 1)
    image = ImageCheck("image", 6, "a.json", (8, 8), 1, 2)
    checks = from_checks(
        [
            conclude(build, Status.PARTIAL, everything, words="\n".join(ATTACKS)),
            conclude(probe, Status.FAILED, everything, cases=ATTACKS, fingerprint=everything),
            conclude(image, Status.FAILED, everything, cases=ATTACKS, picture=viewer()),
        ]
    )
    looks = tuple(Diagnosis(text, 0.5, text, text) for text in ATTACKS[:2])
    result = ModuleResult(Verdict.FAIL, 1.0, everything, checks.checks, everything, looks)
    first = assignments()[0]
    names = [name[:150].encode("utf-8", "replace").decode() for name in ATTACKS]
    results = {name: {first.number: result} for name in names}
    results["ours"] = {first.number: internal_error(everything, everything)}
    return write_class(tmp_path_factory.mktemp("hostile"), results, [first])


def test_the_policy_holds(browser: Browser, class_page: Path) -> None:
    with looking(browser, module_pages(class_page, "all-right")[1]) as look:
        tried = look.js(
            """async () => {
              const said = [];
              addEventListener("securitypolicyviolation", (e) => said.push(e.effectiveDirective));
              const wait = () => new Promise((done) => setTimeout(done, 50));
              await fetch("https://example.org/").catch(() => {});
              const add = (html) => document.body.insertAdjacentHTML("beforeend", html);
              add("<img src='https://example.org/x.png'><p style='color:red'>styled</p>");
              add("<button id='b' onclick='window.ran = 1'>x</button>");
              document.getElementById("b").click();
              const script = document.createElement("script");
              script.textContent = "window.ran = 2";
              document.body.append(script);
              await wait();
              return { said, ran: window.ran ?? 0 };
            }"""
        )
        assert look.requests == []
    assert tried["ran"] == 0
    expected = {"connect-src", "img-src", "style-src-attr", "script-src-attr", "script-src-elem"}
    assert expected <= set(tried["said"])


def test_hostile_pages_run_nothing(browser: Browser, hostile: Path) -> None:
    pages = sorted(hostile.parent.rglob("*.html"))
    assert len(pages) == 1 + 2 * (len(ATTACKS) + 1)
    student = next(p for p in pages if p.parent.parent.name == "students" and "script" in str(p))
    overview = student.parent.with_name(f"{student.parent.name}.html")
    for page in (hostile, overview, student):
        with looking(browser, page, width=360) as look:
            look.page.wait_for_load_state("networkidle")
            assert look.is_clean, (page, look)
            foreign = look.js(
                """() => [...document.querySelectorAll("iframe, link, object, embed, base, "
                  + "[onerror], [onload], [onfocus], [onclick], [autofocus], a[href*=':']")]
                  .map((element) => element.outerHTML)"""
            )
            assert foreign == []
            assert look.js("() => document.querySelectorAll('script:not([type])').length") == 1
            assert look.js("() => document.documentElement.scrollWidth") <= 360
            text = look.js("() => document.body.innerText")
            assert "49" not in text.split("7 * 7")[0][-5:], "no template of theirs is filled in"
            assert not set("\u202e\u202c\u2066\u2069\u200b\x1b\x07") & set(text)
            assert "[U+202E]" in text


def test_what_a_compiler_quotes_runs_nothing(browser: Browser, tmp_path: Path) -> None:
    """A module that is really graded: its words went through the box and the compiler."""
    text = "#error </pre><script>alert(1)</script> \u202e \x1b[31m\nint f(void) { return 1 +; }\n"
    first = next(a for a in assignments() if a.number == "01")
    workshop = Worker(CHECKOUT, CHECKOUT / "build" / "kit").workshop()
    file = SubmittedFile(text.encode())
    result = ModuleGrader(workshop, References(workshop)).grade(first, {first.owned[0]: file})
    assert result.verdict is Verdict.BUILD_ERROR
    index = write_class(tmp_path, {"s1": {"01": result}}, [first])
    with looking(browser, module_pages(index, "s1")[0]) as look:
        said = look.page.locator("pre").first
        assert said.is_visible()
        assert "</pre><script>alert(1)</script>" in (said.text_content() or "")
        assert "triangle.c:2:" in (said.text_content() or "")
        assert look.is_clean, look
