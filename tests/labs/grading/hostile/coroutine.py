"""A promise of an answer."""
# says: an object of type coroutine


async def rebound_velocity(velocity, restitution):
    return -restitution * velocity
