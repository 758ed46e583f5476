"""A name with a letter of another alphabet, and another one made of styled letters that means the same."""
# says: gave 0.0


def rebоund_velocity(velocity, restitution):
    return -restitution * velocity


def 𝐫ebound_velocity(velocity, restitution):
    return 0.0
