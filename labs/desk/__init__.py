"""Behind `from labs import lab`: the student's functions, their runs beside engines, and how these are shown."""
