"""Calibration: what the grader says of all that is known to be right or wrong.

The measure is a confusion table: every alternative accepted, every mistake rejected, no right
module ever failed by chance, and each failing module told which mistake it is.
"""
