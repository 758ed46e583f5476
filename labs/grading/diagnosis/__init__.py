"""Naming the mistake: the bank of known ones, the probes that tell them apart, and a diagnosis in words."""
