"""The tests of a submission: what they compare, what they are worth, and the grade."""
