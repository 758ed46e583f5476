"""What runs inside the processes that untrusted code gets to see: the standard library and NumPy alone."""
