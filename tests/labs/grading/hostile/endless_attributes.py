"""An object whose attributes have no end, asked which of them was meant."""
# says: no answer within|raised AttributeError


class Endless:
    def __dir__(self):
        return [f"attribute_{number}" for number in range(10**7)]


def rebound_velocity(velocity, restitution):
    return Endless().attribute
