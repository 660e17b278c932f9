"""A miniature checkout with a book of two chapters, for the tests of the weaver."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "literate"))
from literate_project import write_project

from raybook_grader.book.editions import Edition
from raybook_grader.book.sphinx_run import Outcome, Settings, run_sphinx

CHECKOUT = Path(__file__).resolve().parents[3]

INDEX = """\
# A small book

```{toctree}
:numbered:
:glob:

chapters/*
```

:::{instructor}
```{toctree}
instructor/notes
```
:::
"""

DISC = """\
# Discs

A disc has a radius; see {frag}`disc.hit` and {id}`disc_area`, and the equation {eq}`eq-area`.

$$ a = \\pi r^2 $$ (eq-area)

:::{source} src/shapes/disc.h
The contract of **discs**.
:::

:::{fragment} disc.types
:::

:::{fragment} disc.contract
:::

:::{source} src/shapes/disc.c
:::

:::{fragment} disc.helper
:::

:::{exercise} disc_hit Hit a disc
Find the place, then its distance.
:::

:::{solution}
The zanzibar of it is that the radius is squared.
:::

:::{fragment} disc.hit
:::

:::{fragment} disc.hit.plane
:::

:::{fragment} disc.hit.point
:::

:::{fragment} disc.hit.stub
:::

:::{fragment} disc.area
:::
"""

MEAN = """\
# Means

:::{source} src/shapes/mean.c
:::

:::{fragment} mean.pair
:::

:::{exercise} mean_pair A mean
Find the *wombat* of two numbers.
:::

| a | b | mean |
| --- | --- | --- |
| 1 | 3 | 2 |

## Many users

:::{source} src/shapes/many.c
:::

MANY_BOXES
## Indices

:::{fragment-index}
:::

:::{identifier-index}
:::
"""

USERS = ("one", "two", "three", "four", "five", "six", "seven")
MANY = "\n".join(
    f"//> many.{n}: Use number {n}\n"
    f"float many_{n}(void)\n{{\n    return DISC_PI;\n}}\n//< many.{n}\n"
    for n in USERS
)
MEAN = MEAN.replace("MANY_BOXES\n", "".join(f":::{{fragment}} many.{n}\n:::\n\n" for n in USERS))


def make_book(root: Path) -> Path:
    """The checkout at `root`, with its docs and the settings of the real book."""
    write_project(root)
    docs = root / "docs"
    for name, text in {
        "index.md": INDEX,
        "chapters/01-disc.md": DISC,
        "chapters/02-mean.md": MEAN,
        "instructor/notes.md": "# Notes\n\nFor the quokka only.\n",
        "references.bib": "",
        "conf.py": (CHECKOUT / "docs" / "conf.py").read_text(encoding="utf-8"),
    }.items():
        (docs / name).parent.mkdir(parents=True, exist_ok=True)
        (docs / name).write_text(text, encoding="utf-8")
    (root / "src" / "shapes" / "many.c").write_text('#include "shapes/disc.h"\n\n' + MANY)
    (root / "src" / "build.mk").write_text("CC := gcc\n")
    (root / "build" / "node").symlink_to(CHECKOUT / "build" / "node")
    return root


def weave(
    root: Path, edition: Edition, builder: str = "html", out: str = "", accept: bool = False
) -> Outcome:
    """Build an edition of the small book."""
    folder = root / "build" / "made" / (out or f"{builder}-{edition}")
    return run_sphinx(Settings(root, accept=accept), edition, builder, folder)


def edit(root: Path, name: str, old: str, new: str) -> None:
    """Replace a text that must be there in a file of the docs."""
    file = root / "docs" / name
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")
