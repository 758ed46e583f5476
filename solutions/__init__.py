"""The lecture by hand, one package per topic, in NumPy alone.

Every function takes arrays with any leading axes and broadcasts over them, so
that one contact or a million is the same code. No function modifies its
arguments.

The bodies are the plain formulas. They need numbers whose products of four are
floats too: a number is 0 or between 1e-60 and 1e60 in size.
"""
