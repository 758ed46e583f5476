"""Cases that other people set up and solved, with their numbers, and how the implementations here answer them.

`theirs` holds the cases, `by_hand` and `in_engines` the functions that answer them, and `drivers` the table that says
which function answers which case.
"""
