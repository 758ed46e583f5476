"""Grading a class: from a folder of submissions, as a platform delivers it, to marks that can be uploaded."""
