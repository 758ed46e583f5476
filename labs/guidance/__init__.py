"""What the labs tell a student without looking at their code: hints, derivations line by line, and drawn figures."""
