"""Writes what a student reads about their functions."""
