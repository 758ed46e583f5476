"""Mistakes that the lab does not know: those that several students share, and the names that a course gives them."""
