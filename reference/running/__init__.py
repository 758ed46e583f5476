"""Jobs in worker processes: which ones a question needs, how they run, and where their results are kept."""
