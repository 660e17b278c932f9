"""The literate core: one marked C source tree, and what is made from it.

`markers` parses a file into `pieces`; `tree` reads all of `src/` and `check` says what is wrong
with it; `export` writes the student's text of a file and `handout` the whole student edition;
`leaks` searches any artefact for lines of the solutions. Only the standard library is needed.
"""
