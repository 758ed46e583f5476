"""The catalogue: what a family of cases is, what is measured in it, and the scenarios themselves."""
