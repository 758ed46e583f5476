"""Timings of our own code beside other programs and libraries."""
