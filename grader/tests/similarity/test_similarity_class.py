"""Copies are found, however disguised; independent work and the handout are not."""

from __future__ import annotations

import random
import re
from itertools import combinations

import pytest
from course_text import CHECKOUT, COURSE, OWNED, copied, documents, of_museum, submission

from raybook_grader.checks.stub import stub_text
from raybook_grader.similarity.document import SHORTEST, Document, Owner, document
from raybook_grader.similarity.pair import compare
from raybook_grader.similarity.search import handout_base, search
from raybook_grader.similarity.settings import LENGTH, THRESHOLD
from raybook_grader.submissions import SubmittedFile

BASE = handout_base(CHECKOUT)
BVH = OWNED["03"]


def one(number: str, files: dict[str, str], name: str = "x") -> Document:
    made = document(Owner(name), submission(name, files).files, BASE)
    assert isinstance(made, Document), made
    return made


def bvh(slug: str) -> str:
    return of_museum("03")[slug][BVH[0]]


def similarity(number: str, first: dict[str, str], second: dict[str, str]) -> float:
    return compare(one(number, first), one(number, second)).similarity


def test_other_names_and_comments_change_nothing() -> None:
    text = bvh("sah-sweep")
    copy = copied(text, random.Random(1))
    bare = [re.sub(r"(?s)/\*.*?\*/|#[^\n]*", "", words) for words in (text, copy)]
    names = [set(re.findall(r"\b[a-z]+_\w+\b", words)) for words in bare]
    assert names[0] and not names[0] & names[1]
    assert similarity("03", {BVH[0]: text}, {BVH[0]: copy}) > 0.95


def test_functions_in_another_order_are_found() -> None:
    text = bvh("sah-sweep")
    parts = re.split(r"(?m)^(?=static )", text)
    assert len(parts) > 5
    random.Random(2).shuffle(parts)
    assert similarity("03", {BVH[0]: text}, {BVH[0]: "".join(parts)}) > 0.8


def test_a_module_copied_into_a_longer_one_is_found() -> None:
    mine, others = bvh("median-quickselect"), bvh("lbvh-morton")
    assert similarity("03", {BVH[0]: mine}, {BVH[0]: others + mine}) > 0.95


@pytest.mark.parametrize("number", sorted(OWNED))
def test_a_line_by_line_rework_is_found(number: str) -> None:
    """A token added, changed or removed in every 40: far more than any disguise of names."""
    rng = random.Random(number)
    for slug, files in of_museum(number).items():
        copy = {path: _reworked(text, rng) for path, text in files.items()}
        assert similarity(number, files, copy) >= THRESHOLD, slug


def _reworked(text: str, rng: random.Random) -> str:
    words = re.split(r"(\W+)", text)
    return "".join(
        w + rng.choice((" + 1", "", " x;")) if rng.random() < 1 / 80 else w for w in words
    )


def test_independent_work_is_not_found() -> None:
    """The measurement behind the threshold; it has to stay as far away."""
    shares = []
    for number in sorted(OWNED):
        museum = of_museum(number)
        for (_, a), (_, b) in combinations(documents(number, museum, BASE), 2):
            mine, theirs = dict(a.texts), dict(b.texts)
            if not any(mine[path] == theirs[path] for path in mine):
                shares.append(compare(a, b).similarity)
    assert len(shares) > 100
    assert max(shares) < 0.6 * THRESHOLD


def test_the_handout_does_not_count() -> None:
    for number, paths in OWNED.items():
        stubs = {path: stub_text(CHECKOUT, path) for path in paths}
        made = document(Owner("x"), submission("x", stubs).files, BASE)
        assert made == f"fewer than {SHORTEST} tokens of its own", number


def test_only_ones_own_tokens_count() -> None:
    """Two independent solutions with the same large piece of the handout in both."""
    given = stub_text(CHECKOUT, "src/scene/load.c")
    with_it = [{BVH[0]: given + bvh(slug)} for slug in ("sah-sweep", "lbvh-morton")]
    without = [{BVH[0]: bvh(slug)} for slug in ("sah-sweep", "lbvh-morton")]
    assert similarity("03", *with_it) == pytest.approx(similarity("03", *without), abs=0.05)


def test_a_class_is_compared_with_itself_and_with_earlier_years() -> None:
    rng = random.Random(3)
    ours = [
        submission("anna", {BVH[0]: bvh("sah-sweep")}),
        submission("bo", {BVH[0]: copied(bvh("sah-sweep"), rng)}),
        submission("carl", {BVH[0]: copied(bvh("lbvh-morton"), rng)}),
        submission("stub", {BVH[0]: stub_text(CHECKOUT, BVH[0])}),
        submission("nothing", {}),
    ]
    old = [
        submission("x1", {BVH[0]: bvh("lbvh-morton")}),
        submission("x2", {BVH[0]: copied(bvh("lbvh-morton"), rng)}),
    ]
    found = {f.assignment.number: f for f in search(COURSE, ours, {"2025": old}, THRESHOLD)}
    module = found["03"]
    names = [(pair.a.owner.name, pair.b.owner.name) for pair in module.alike]
    assert sorted(names) == [("anna", "bo"), ("carl", "2025/x1"), ("carl", "2025/x2")]
    assert module.compared == 3 and module.pairs == 3 + 6
    assert module.left_out == (("stub", f"fewer than {SHORTEST} tokens of its own"),)
    assert module.next is not None and module.next < 0.3
    assert not found["01"].alike and found["01"].pairs == 0


def test_files_that_are_refused_or_endless_are_left_out() -> None:
    refused = {BVH[0]: SubmittedFile(refusal="a link")}
    assert isinstance(document(Owner("x"), refused, BASE), str)
    endless = {BVH[0]: SubmittedFile(b"x+" * 200_000)}
    assert document(Owner("x"), endless, BASE) == "longer than 256 KiB"


def test_a_text_that_repeats_itself_is_compared_in_full() -> None:
    line = "    total += weights[i] * values[i] - (float)count / limit;\n" * 12
    files = {BVH[0]: "void f(void) {\n" + line + "}\n"}
    pair = compare(one("03", files), one("03", files))
    assert pair.share_a == pair.share_b == 1


def test_nothing_is_alike_over_the_end_of_a_file() -> None:
    first, second = OWNED["05"]
    half = "    p = q * r + s - t / u + v * w;\n"
    files = {first: "void f(void) {\n" + half * 9 + "}\n", second: half * 9}
    made = one("05", files)
    places = [i for at in made.prints.hash_idx.values() for i in at]
    assert places and {made.spans[i][0] for i in places} == {0, 1}
    assert all(made.spans[i][0] == made.spans[i + LENGTH - 1][0] for i in places)
