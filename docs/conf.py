"""The book's settings. What it is made with is in grader/raybook_grader/book/."""

from pathlib import Path

_root = Path(__file__).resolve().parents[1]

project = "Raybook"
author = "the Raybook course"
copyright = "the Raybook course; code under the MIT licence"
version = release = "0.1.0"
language = "en"

extensions = ["myst_parser", "sphinxcontrib.bibtex", "raybook_grader.book.weaver"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["figures/**"]
templates_path = ["_templates"]

# What `make book` sets for each edition.
book_edition = "instructor"
book_root = str(_root)
book_node = str(_root / "build" / "node")
book_assets = str(_root / "build" / "book" / "assets")
book_figures = str(_root / "build" / "book" / "figures")
book_manifest = str(_root / "docs" / "figures" / "manifest.json")

# What a chapter may say.
myst_enable_extensions = ["amsmath", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
bibtex_bibfiles = ["references.bib"]
bibtex_default_style = "author-year"
bibtex_reference_style = "author_year"
numfig = True
math_numfig = True
math_eqref_format = "({number})"
nitpicky = True
suppress_warnings = ["myst.strikethrough"]

# The pages. The search's summaries would fetch pages, which a browser refuses to a local file.
html_theme = "furo"
html_title = "Raybook"
html_math_renderer = "raybook"
html_copy_source = False
html_show_sourcelink = False
html_show_search_summary = False
html_use_index = False
html_domain_indices = False
html_permalinks_icon = "¶"
html_scaled_image_link = False
_serif = "'Source Serif 4 Variable', Charter, Georgia, 'Noto Serif', 'KaTeX_Main', serif"
_mono = "'Source Code Pro Variable', ui-monospace, 'DejaVu Sans Mono', 'KaTeX_Main', monospace"
html_theme_options = {
    "navigation_with_keys": True,
    "light_css_variables": {
        "font-stack": _serif,
        "font-stack--monospace": _mono,
        "font-stack--headings": "'Source Sans 3 Variable', system-ui, sans-serif",
        "color-brand-primary": "#1d4f8c",
        "color-brand-content": "#1d4f8c",
        "color-brand-visited": "#5a3f86",
        "color-background-primary": "#fffefb",
        "color-background-secondary": "#f7f5ef",
        "color-background-border": "#e4e0d6",
        "color-foreground-primary": "#1d1f23",
        "color-foreground-secondary": "#4d5159",
        "color-foreground-muted": "#5f646d",
        "color-code-background": "#f7f5ef",
        "color-code-foreground": "#1d1f23",
        "color-inline-code-background": "#f3f0e8",
    },
    "dark_css_variables": {
        "color-brand-primary": "#9cc3f5",
        "color-brand-content": "#9cc3f5",
        "color-brand-visited": "#c9b2f0",
        "color-background-primary": "#16181c",
        "color-background-secondary": "#1c1f24",
        "color-background-border": "#31353d",
        "color-foreground-primary": "#d9dbdf",
        "color-foreground-secondary": "#b0b5bd",
        "color-foreground-muted": "#9aa0aa",
        "color-code-background": "#1c1f24",
        "color-code-foreground": "#d9dbdf",
        "color-inline-code-background": "#24282e",
    },
}
