"""What a student reads about their functions."""
