"""A syntax error that says it stands in line two billion of the submission."""
# says: raised SyntaxError


def rebound_velocity(velocity, restitution):
    raise SyntaxError("expected \x1b[2J", ("submission", 2**31, "nowhere", "text\n" * 10**5))
