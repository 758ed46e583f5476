"""A list that holds itself."""
# says: nested more than


def rebound_velocity(velocity, restitution):
    answer = []
    answer.append(answer)
    return answer
