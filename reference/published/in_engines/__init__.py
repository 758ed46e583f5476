"""How the engines run the published cases: a scenario of each, what is read from it, how near its method must come."""
