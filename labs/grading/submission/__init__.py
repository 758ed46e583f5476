"""A student's file as the source text of its functions."""
