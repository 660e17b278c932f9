"""The student's own loop: check, watch, hint, debug and report.

It runs in the student edition, on what was shipped with it, and in the course's own checkout, on
the reference itself (`raybook_grader.expected`). Nothing here knows a solution.
"""
