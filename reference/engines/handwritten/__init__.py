"""Drivers of hand-written code: step loops and queries that call the functions of an implementation."""
