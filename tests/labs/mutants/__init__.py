"""Mutants: right functions with one thing wrong, made by fixed operators, to see whether tests notice.

`operators` says what can be wrong in an expression, `arguments` what can be wrong with what a function is given, and
`making` makes the functions. Nothing is drawn: the same solution has the same mutants, in the same order.
"""
