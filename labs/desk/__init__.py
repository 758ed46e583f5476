"""What stands behind `from labs import lab`: the student's functions, runs beside engines, and how they are shown."""
