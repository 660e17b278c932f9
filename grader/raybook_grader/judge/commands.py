"""The command `compare` of raybook-grader: any two pictures."""

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from markupsafe import Markup

from ..errors import BadInput
from ..files import write_bytes
from ..page import assets, environment
from .compare import Comparison, compare, summary
from .exr import UnusableImage, read_exr
from .facts import facts_of_pair
from .findings import first_pixel
from .pixels import Image
from .viewer import VIEWER_SCRIPTS, VIEWER_STYLES, viewer_html

if TYPE_CHECKING:
    # argparse has no public name for what add_subparsers() returns.
    Subparsers = argparse._SubParsersAction[argparse.ArgumentParser]

SAME, DIFFERENT, UNUSABLE = 0, 1, 2


def add_commands(subparsers: "Subparsers") -> None:
    """Register `compare`; its `handler` gives the exit code."""
    parser = subparsers.add_parser(
        "compare",
        help="say whether two pictures are the same but for noise",
        description="Compares two EXR pictures: bias beyond noise, FLIP and Delta E ITP.",
        epilog="Exit code: 0 the same, 1 different, 2 a picture is unusable. Noise is measured "
        "within the pair, so what looks like noise can't be told from it: render more samples for "
        "a sharper answer.",
    )
    parser.add_argument("reference", metavar="REFERENCE.exr", type=Path)
    parser.add_argument("test", metavar="TEST.exr", type=Path)
    parser.add_argument("--html", metavar="FILE", type=Path, help="write a page with a viewer")
    parser.add_argument("--json", action="store_true", help="print the numbers as JSON")
    parser.set_defaults(handler=run_compare)


def run_compare(arguments: argparse.Namespace) -> int:
    """0 the same, 1 different, 2 unusable: then one message, and with --json an object as well."""
    try:
        reference, test = _read(arguments.reference, arguments.test)
        result = compare(reference, test)
        if arguments.html:
            _write_page(arguments, reference, test, result)
    except BadInput as problem:
        if arguments.json:
            _print_json(_unusable(str(problem)))
        print(f"raybook-grader: {problem}", file=sys.stderr)
        return UNUSABLE
    if arguments.json:
        _print_json(result.as_json())
    else:
        print(summary(result))
    return SAME if result.same else DIFFERENT


def _read(reference_path: Path, test_path: Path) -> tuple[Image, Image]:
    reference, test = read_exr(reference_path).pixels, read_exr(test_path).pixels
    bad = ~np.isfinite(reference).all(axis=-1)
    if bad.any():
        x, y = first_pixel(bad)
        raise UnusableImage(
            f"{reference_path}: a reference must be finite; {int(bad.sum())} of its pixels are NaN "
            f"or infinite, the first at x={x}, y={y}"
        )
    return reference, test


def _write_page(
    arguments: argparse.Namespace, reference: Image, test: Image, result: Comparison
) -> None:
    viewer = ""
    n = result.numbers
    if n:
        viewer = viewer_html(
            reference,
            test,
            n.flip_map,
            "Where they differ",
            delta_e=n.colour.map,
            white=n.viewing.white,
            test_name="Test",
            facts=facts_of_pair(n),
        )
    page = (
        environment(__package__ or "")
        .get_template("compare.html")
        .render(
            assets=assets(VIEWER_STYLES, VIEWER_SCRIPTS),
            comparison=result,
            reference_path=str(arguments.reference),
            test_path=str(arguments.test),
            viewer=Markup(viewer),  # escaped where it was made
        )
    )
    content = page.encode("utf-8", "replace")
    try:
        write_bytes(arguments.html, content)
    except OSError as error:
        raise BadInput(f"{arguments.html}: cannot be written: {error.strerror}") from None


def _unusable(reason: str) -> dict[str, object]:
    return Comparison(()).as_json() | {"same": False, "reason": reason}


def _print_json(value: dict[str, object]) -> None:
    print(json.dumps(value, allow_nan=False))
