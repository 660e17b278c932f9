"""Grading: one module (`module`), a whole class (`run`), and what it all adds up to."""
