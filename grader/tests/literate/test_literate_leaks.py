"""Planted leaks are found in every form in which a student may get them; nothing else is."""

from __future__ import annotations

import bz2
import gzip
import io
import json
import lzma
import os
import shutil
import subprocess
import tarfile
import zipfile
from pathlib import Path

import pytest
from literate_project import ALTERNATIVE, DISC_C, HIDDEN_TEST, MISTAKE, write_project

from raybook_grader.literate.leaks import ScanReport, scan
from raybook_grader.literate.secrets import Secrets, checkout_secrets

PLANTED = "    float x = r->origin[0] + t_plane * r->direction[0];"
SECRET = PLANTED.strip()
ORIGIN = f"src/shapes/disc.c:{DISC_C.split(chr(10)).index(PLANTED) + 1}"


@pytest.fixture
def secrets(tmp_path: Path) -> Secrets:
    return checkout_secrets(write_project(tmp_path / "checkout"))


@pytest.fixture
def artefact(tmp_path: Path) -> Path:
    folder = tmp_path / "artefact"
    folder.mkdir()
    return folder


def messages(report: ScanReport) -> list[str]:
    assert report.unread == ()
    return [str(leak) for leak in report.leaks]


# What is a secret.


def texts(secrets: Secrets, folder: str = "src/") -> set[str]:
    return {line.text for line in secrets.lines if line.file.startswith(folder)}


def test_solution_lines_are_secrets(secrets: Secrets) -> None:
    assert SECRET in texts(secrets)
    assert "return x * x + y * y <= radius * radius;" in texts(secrets)
    assert "return a + 0.5f * (b - a);" in texts(secrets)


def test_short_and_visible_lines_are_no_secrets(secrets: Secrets) -> None:
    assert "return true;" not in texts(secrets)  # 11 characters without the blank
    assert "return false;" not in texts(secrets)  # the stub returns it too
    assert "assert(d->radius > 0.0f);" not in texts(secrets)


def test_part_of_a_visible_line_is_no_secret(tmp_path: Path) -> None:
    call = "long_visible_call();\n"
    text = f"a;\n#ifndef TODO_mean_pair\n{call}#else\nif (b) {call}#endif\n"
    root = write_project(tmp_path, {"src/shapes/mean.c": text})
    assert "long_visible_call();" not in texts(checkout_secrets(root))


def test_revealed_solutions_are_no_secrets(tmp_path: Path) -> None:
    revealed = checkout_secrets(write_project(tmp_path), ["01"])
    assert texts(revealed) == {"return a + 0.5f * (b - a);"}


def test_instructor_lines_are_secrets(secrets: Secrets) -> None:
    found = texts(secrets, "assignments/")
    assert "TEST_ASSERT_FALSE(hits_disc_at_grazing_angle(1e-7f));" in found
    assert "float rise_to_plane = d->height - r->origin[2];" in found
    assert "return x * x + y * y <= radius; /* wrong by a factor */" in found


def test_words_and_common_lines_of_instructors_are_no_secrets(secrets: Secrets) -> None:
    found = texts(secrets, "assignments/")
    assert not any("square" in text or "what is the unit" in text for text in found)
    assert '#include "unity.h"' not in found
    assert not any("bool disc_hit(" in text for text in found)
    assert not any("how often" in text for text in found)


def test_hidden_data_is_secret_where_it_has_words(secrets: Secrets) -> None:
    found = [line.text for line in secrets.lines if line.file.endswith("rays.txt")]
    assert found == ["grazing the rim from below | 1 0 0 | 0 1 0"]


def test_lines_after_a_hunk_are_words_again(tmp_path: Path) -> None:
    patch = MISTAKE + "-- \nthese words stand below the patch itself\n"
    root = write_project(tmp_path, {"assignments/01-disc/mistakes/no-square.patch": patch})
    assert not any("these words" in text for text in texts(checkout_secrets(root), "assignments/"))


# Where they are found.


def test_text(artefact: Path, secrets: Secrets) -> None:
    (artefact / "notes").mkdir()
    (artefact / "notes/a.txt").write_text(f"one\ntwo\n\t{SECRET.replace(' ', '   ')}\n")
    assert messages(scan(artefact, secrets)) == [f"LEAK {ORIGIN} in notes/a.txt:3: {SECRET}"]


def test_every_occurrence_is_reported(artefact: Path, secrets: Secrets) -> None:
    (artefact / "a.txt").write_text(f"{SECRET}\n\n{SECRET}{SECRET}\n")
    (artefact / "b.txt").write_text("float y = r->origin[1] + t_plane * r->direction[1];")
    places = [
        message.split(" in ")[1].split(": ")[0] for message in messages(scan(artefact, secrets))
    ]
    assert places == ["a.txt:1", "a.txt:3", "b.txt:1"]


def test_line_wrapped_over_two(artefact: Path, secrets: Secrets) -> None:
    (artefact / "a.txt").write_text("x\n" + SECRET.replace("+ ", "+\n      "))
    assert messages(scan(artefact, secrets)) == [f"LEAK {ORIGIN} in a.txt:2: {SECRET}"]


def test_single_file(artefact: Path, secrets: Secrets) -> None:
    (artefact / "a.txt").write_text(SECRET)
    assert messages(scan(artefact / "a.txt", secrets)) == [f"LEAK {ORIGIN} in a.txt:1: {SECRET}"]


HTML = {
    "tags and entities": (
        '<pre>\n<span class="kt">float</span> <span\nclass="n">x</span> = '
        '<a href="#r">r</a>-&gt;origin[<b>0</b>] &#43; t_plane * r-&gt;direction[0];</pre>'
    ),
    "after a tag and an entity of two lines": (
        '<a\nhref="#">x&#10;y</a>\n' + SECRET.replace("->", "<b>-&gt;</b>")
    ),
    "in an attribute": f'<p>\n\n<button data-code="{SECRET.replace(">", "&gt;")}">copy</button>',
    "in a comment": f"\n\n<!-- {SECRET} -->",
    "in a script": "\n\n<script>var code = " + json.dumps(SECRET).replace(">", "\\u003e"),
    "zero-width spaces": "\n\n" + SECRET.replace("->", "-&gt;\u200b"),
}


@pytest.mark.parametrize("form", HTML)
def test_html(artefact: Path, secrets: Secrets, form: str) -> None:
    (artefact / "page.html").write_text(HTML[form], encoding="utf-8")
    line = 2 if form == "tags and entities" else 3
    assert messages(scan(artefact, secrets)) == [f"LEAK {ORIGIN} in page.html:{line}: {SECRET}"]


def test_search_index(artefact: Path, secrets: Secrets) -> None:
    page = f"int main(void)\n{{\n{PLANTED}\n<b>}}</b>"
    (artefact / "index.json").write_text(json.dumps({"pages": [{"text": page}]}, indent=1))
    (artefact / "index.js").write_text("\nSearch.setIndex(" + json.dumps({"a": page}) + ")")
    found = messages(scan(artefact, secrets))
    assert found == [
        f"LEAK {ORIGIN} in index.js:2: {SECRET}",
        f"LEAK {ORIGIN} in index.json:4: {SECRET}",
    ]


def test_html_in_json(artefact: Path, secrets: Secrets) -> None:
    html = SECRET.replace("->", "<span>-&gt;</span>")
    (artefact / "index.json").write_text(json.dumps([html]))
    assert messages(scan(artefact, secrets)) == [f"LEAK {ORIGIN} in index.json:1: {SECRET}"]


def test_utf16(artefact: Path, secrets: Secrets) -> None:
    (artefact / "a.txt").write_text(SECRET, encoding="utf-16")
    assert len(messages(scan(artefact, secrets))) == 1


def zipped(members: dict[str, bytes]) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    return buffer.getvalue()


def tarred(members: dict[str, bytes], mode: str) -> bytes:
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode=mode) as archive:  # type: ignore[call-overload]
        for name, data in members.items():
            info = tarfile.TarInfo(name)
            info.size = len(data)
            archive.addfile(info, io.BytesIO(data))
    return buffer.getvalue()


LEAKY = {"doc/a.txt": f"\n{PLANTED}\n".encode(), "b.txt": b"harmless\n"}
ARCHIVES = {
    "a.zip": (zipped(LEAKY), "a.zip!doc/a.txt"),
    "a.tar": (tarred(LEAKY, "w"), "a.tar!doc/a.txt"),
    "a.tar.gz": (tarred(LEAKY, "w:gz"), "a.tar.gz!!doc/a.txt"),
    "a.tar.xz": (tarred(LEAKY, "w:xz"), "a.tar.xz!!doc/a.txt"),
    "a.txt.gz": (gzip.compress(LEAKY["doc/a.txt"]), "a.txt.gz!"),
    "a.txt.bz2": (bz2.compress(LEAKY["doc/a.txt"]), "a.txt.bz2!"),
    "a.txt.xz": (lzma.compress(LEAKY["doc/a.txt"]), "a.txt.xz!"),
    "nested.zip": (zipped({"in.zip": zipped(LEAKY)}), "nested.zip!in.zip!doc/a.txt"),
    "no-suffix": (zipped(LEAKY), "no-suffix!doc/a.txt"),
}


@pytest.mark.parametrize("name", ARCHIVES)
def test_archive(artefact: Path, secrets: Secrets, name: str) -> None:
    data, member = ARCHIVES[name]
    (artefact / name).write_bytes(data)
    assert messages(scan(artefact, secrets)) == [f"LEAK {ORIGIN} in {member}:2: {SECRET}"]


def test_instructor_files_by_content(artefact: Path, secrets: Secrets) -> None:
    (artefact / "data.bin").write_text("one two three\n")
    (artefact / "t.zip").write_bytes(zipped({"x.c": ALTERNATIVE.encode()}))
    found = messages(scan(artefact, secrets))
    folder = "assignments/01-disc"
    assert f"LEAK {folder}/hidden/expected.bin:1 in data.bin:1: the whole file" in found
    assert f"LEAK {folder}/alternatives/hypot.c:1 in t.zip!x.c:1: the whole file" in found


def test_instructor_files_by_line(artefact: Path, secrets: Secrets) -> None:
    (artefact / "page.html").write_text("<pre>" + HIDDEN_TEST.split("\n")[3])
    (found,) = messages(scan(artefact, secrets))
    assert found.startswith("LEAK assignments/01-disc/hidden/test_grazing.c:4 in page.html:1: ")


def test_revealed_solution_may_be_seen(tmp_path: Path, artefact: Path) -> None:
    (artefact / "a.txt").write_text(SECRET)
    assert scan(artefact, checkout_secrets(write_project(tmp_path / "checkout"), ["01"])).clean


def test_harmless_artefact_is_clean(artefact: Path, secrets: Secrets) -> None:
    (artefact / "a.html").write_text("<p>assert(d-&gt;radius &gt; 0.0f); return true;</p>")
    (artefact / "a.json").write_text('{"a": "\\ud83d\\\\"}')
    (artefact / "empty").write_bytes(b"")
    report = scan(artefact, secrets)
    assert report.clean and report.documents == 3


# What can't be read is never taken as clean.


def test_broken_archive_is_not_clean(artefact: Path, secrets: Secrets) -> None:
    (artefact / "a.zip").write_bytes(zipped(LEAKY)[:60])
    (artefact / "b.gz").write_bytes(gzip.compress(b"a" * 100)[:15])
    report = scan(artefact, secrets)
    assert [name.split(":")[0] for name in report.unread] == ["a.zip", "b.gz"]
    assert not report.clean


def git(folder: Path, *words: str) -> None:
    identity = ["-c", "user.name=t", "-c", "user.email=t@example.org"]
    environment = {k: v for k, v in os.environ.items() if not k.startswith("GIT_")}
    command = ["git", "-C", str(folder), *identity, *words]
    subprocess.run(command, check=True, capture_output=True, env=environment)


def commit(folder: Path, text: str, message: str, *options: str) -> None:
    (folder / "a.c").write_text(text)
    git(folder, "add", "a.c")
    git(folder, "commit", "-q", "-m", message, *options)


@pytest.mark.parametrize("then", ["later", "amended", "packed"])
def test_leak_in_a_git_history(artefact: Path, secrets: Secrets, then: str) -> None:
    sub = artefact / "sub"
    sub.mkdir()
    git(sub, "init", "-q")
    commit(sub, f"{PLANTED}\n", "a solution")
    commit(sub, "int a;\n", "and away", *(["--amend"] if then == "amended" else []))
    if then == "packed":
        git(sub, "gc", "-q")
    [leak] = scan(artefact, secrets).leaks
    assert (leak.secret.text, leak.line) == (SECRET, 1)
    assert leak.artefact.startswith("sub/.git!blob ")


def test_leak_in_a_commit_message(artefact: Path, secrets: Secrets) -> None:
    git(artefact, "init", "-q")
    commit(artefact, "int a;\n", f"try {SECRET}")
    [leak] = scan(artefact, secrets).leaks
    assert leak.artefact.startswith(".git!commit ")


def test_a_clean_git_history(artefact: Path, secrets: Secrets) -> None:
    git(artefact, "init", "-q")
    commit(artefact, "int a;\n", "nothing to see")
    assert scan(artefact, secrets).clean


def test_a_history_that_is_not_all_there_is_not_clean(artefact: Path, secrets: Secrets) -> None:
    git(artefact, "init", "-q")
    commit(artefact, "int a;\n", "one")
    (artefact / ".git/shallow").write_text("")
    assert scan(artefact, secrets).unread == (".git: part of the history is not in it (shallow)",)


def test_a_broken_git_repository_is_not_clean(artefact: Path, secrets: Secrets) -> None:
    (artefact / "sub/.git/objects").mkdir(parents=True)
    (artefact / "sub/.git/objects/a").write_bytes(b"packed")
    [reason] = scan(artefact, secrets).unread
    assert reason.startswith("sub/.git: git: fatal:")


def test_missing_artefact(tmp_path: Path, secrets: Secrets) -> None:
    with pytest.raises(FileNotFoundError, match="no such file or folder to scan"):
        scan(tmp_path / "nowhere", secrets)


def test_pdf_without_pdftotext_is_not_clean(
    artefact: Path, secrets: Secrets, monkeypatch: pytest.MonkeyPatch
) -> None:
    (artefact / "a.pdf").write_bytes(b"%PDF-1.4\n")
    monkeypatch.setenv("PATH", str(artefact))
    assert scan(artefact, secrets).unread == ("a.pdf: pdftotext (poppler-utils) is not installed",)


def pdf(text: str) -> bytes:
    """A page with one line of text."""
    drawing = "BT /F1 10 Tf 20 100 Td ({}) Tj ET".format(
        text.replace("(", "\\(").replace(")", "\\)")
    )
    objects = [
        "<< /Type /Catalog /Pages 2 0 R >>",
        "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 600 200] /Contents 4 0 R"
        " /Resources << /Font << /F1 5 0 R >> >> >>",
        f"<< /Length {len(drawing)} >>\nstream\n{drawing}\nendstream",
        "<< /Type /Font /Subtype /Type1 /BaseFont /Courier >>",
    ]
    out, offsets = "%PDF-1.4\n", []
    for number, body in enumerate(objects, 1):
        offsets.append(len(out))
        out += f"{number} 0 obj\n{body}\nendobj\n"
    table = "".join(f"{offset:010} 00000 n \n" for offset in offsets)
    count = len(objects) + 1
    return (
        f"{out}xref\n0 {count}\n0000000000 65535 f \n{table}"
        f"trailer\n<< /Size {count} /Root 1 0 R >>\nstartxref\n{len(out)}\n%%EOF\n"
    ).encode()


@pytest.mark.skipif(not shutil.which("pdftotext"), reason="needs pdftotext (poppler-utils)")
def test_pdf(artefact: Path, secrets: Secrets) -> None:
    (artefact / "book.pdf").write_bytes(pdf(SECRET))
    assert messages(scan(artefact, secrets)) == [f"LEAK {ORIGIN} in book.pdf:1: {SECRET}"]


@pytest.mark.skipif(not shutil.which("pdftotext"), reason="needs pdftotext (poppler-utils)")
def test_broken_pdf_is_not_clean(artefact: Path, secrets: Secrets) -> None:
    (artefact / "book.pdf").write_bytes(b"%PDF-1.4\nnothing\n")
    assert not scan(artefact, secrets).clean
