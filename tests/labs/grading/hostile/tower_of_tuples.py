"""Tuples in tuples, each twice in the next: a million from twenty."""
# says: message of [0-9]+ parts|nested more than|no answer within


def rebound_velocity(velocity, restitution):
    tower = (0.0,)
    for _ in range(18):
        tower = (tower, tower)
    return tower
