"""Measured against expected: verdicts, studies of an error, and the results that carry them."""
