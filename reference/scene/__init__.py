"""A scene in no engine's words: scenario, settings, queries, trajectory, and the geometry of its shapes."""
