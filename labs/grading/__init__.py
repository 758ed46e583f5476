"""Checks a student's work: reads the submission as text, runs it in a worker, and reports what is right and wrong."""
