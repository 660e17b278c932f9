"""The plots of the book that show data: measured by the renderer while the book is made.

`measured` and `points` say what is measured, `drawing` how it looks, `table` which plot is which.
Seeds are fixed: the same code gives the same plot.
"""
