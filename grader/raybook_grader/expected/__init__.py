"""What right pictures look like, rendered by the reference: for the student edition, which ships
it, and for `make check` in the course's own checkout. Instructors only."""
