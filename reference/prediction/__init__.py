"""What each method must give, step by step: its recurrence for a scenario, run from the scenario's own start."""
