"""Measured against expected: rows, verdicts, studies of an error, and the results that carry them."""
