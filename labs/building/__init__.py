"""From lessons and solutions to what people open: notebooks for students, solved ones, and what is released."""
