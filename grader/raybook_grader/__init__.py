"""Raybook's grader: judges submissions to the course and weaves its book."""
