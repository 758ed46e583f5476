"""Recordings of what engines measured: making and reading them, and the hash that says which run they belong to."""
