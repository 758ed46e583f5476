"""Names the mistake: the bank of known ones, the probes that distinguish them, and a diagnosis in words."""
