"""`make report`: the student's report.md with pictures and timings of their own build.

`page` reads the text, `renderings` draws what it asks for, `write` makes HTML and PDF of it.
"""
