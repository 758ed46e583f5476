"""A dictionary for an answer."""
# says: an object of type dict


def rebound_velocity(velocity, restitution):
    return {"answer": -restitution * velocity}
