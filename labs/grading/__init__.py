"""What checks a student's work: the submission as text, the worker that runs it, and what is said about it."""
