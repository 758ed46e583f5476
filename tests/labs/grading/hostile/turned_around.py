"""A comment that turns the direction of writing, so that the code reads otherwise than it runs."""
# says: gave 0.0


def rebound_velocity(velocity, restitution):
    right = "‮ no ⁦"  # ‮ right ⁦
    return 0.0 if right else -restitution * velocity
