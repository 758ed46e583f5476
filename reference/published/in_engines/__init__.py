"""How the engines answer the published cases: each driver sets up a scenario, runs it and reads the figures from it."""
