"""An autograder that Gradescope can run: what is in it, and what it does there."""
