"""Doing many pure jobs at once, and saying how far they are."""
