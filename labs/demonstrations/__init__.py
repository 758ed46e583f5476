"""Questions for a lecture hall, what their runs gave, and their replay."""
