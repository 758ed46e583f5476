"""One operation that takes longer than anybody waits."""
# says: no answer within|MemoryError


def rebound_velocity(velocity, restitution):
    return float(9**9 ** velocity.__trunc__().__abs__().__pow__(9))
