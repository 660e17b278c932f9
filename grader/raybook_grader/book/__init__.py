"""The book: chapters in MyST Markdown, woven with the C source that they tell of.

`editions` says what a reader sees of the source; `weaver` is the Sphinx extension that shows it
(`docs/conf.py` only configures it); `build` is `make book`: both editions as HTML and PDF, and
every check that they must pass.
"""
