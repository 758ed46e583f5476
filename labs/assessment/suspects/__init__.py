"""Wrong functions, in each of which one thing is wrong. A student finds an input that shows it.

Each lab has a module of its name with a table `SUSPECTS`: key → function. They are mistakes of the bank
(`tests/autograder/misconceptions`), written out for one case, so that a release can hold them without the bank.
"""
