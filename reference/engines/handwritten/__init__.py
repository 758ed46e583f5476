"""The drivers of the hand-written side: step loops and queries that call the functions of an implementation."""
