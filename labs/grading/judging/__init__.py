"""The tests of a submission: what they expect, what they are worth, and the grade."""
