"""How hand-written code answers the published cases: each driver asks an implementation's functions by name."""
