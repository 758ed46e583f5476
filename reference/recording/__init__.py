"""What engines measured where they were installed: reading it, making it, and the hash that says what it belongs to."""
