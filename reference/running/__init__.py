"""Jobs in worker processes: which jobs a study needs, how they run, and where their results are kept."""
