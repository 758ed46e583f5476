"""What a student opens, and what checks their work."""
