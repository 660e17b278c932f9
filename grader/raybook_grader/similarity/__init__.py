"""Submissions that are alike: pairs for a person to look at, by copydetect's fingerprints."""
