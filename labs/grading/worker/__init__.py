"""Runs inside the processes that untrusted code can see, and needs only the standard library and NumPy."""
