"""Right answers by functions of functions: lambdas, partials, closures, nested functions, recursion, decorators."""

import functools
import operator

import numpy as np

along = functools.partial(np.sum, axis=-1)
dot = lambda a, b: along(np.multiply(a, b))  # noqa: E731
upright = functools.partial(np.expand_dims, axis=-1)


def as_arrays(function):
    @functools.wraps(function)
    def called(*arguments, **named):
        def array(value):
            return tuple(map(array, value)) if isinstance(value, tuple) else np.asarray(value, dtype=float)

        return function(*map(array, arguments), **named)

    return called


def composed(*functions):
    return functools.reduce(lambda f, g: lambda *given: f(g(*given)), functions)


def added(*vectors):
    return vectors[0] if len(vectors) == 1 else vectors[0] + added(*vectors[1:])


def impulse_on(sign):
    def after(body, impulse):
        velocity, spin, arm, share, turning = body
        j = sign * impulse
        return added(velocity, upright(share) * j), added(spin, np.matvec(turning, np.cross(arm, j)))

    return after


on_a, on_b = impulse_on(+1), impulse_on(-1)

point_velocity = lambda velocity, angular_velocity, arm: added(velocity, np.cross(angular_velocity, arm))  # noqa: E731
relative_velocity = as_arrays(operator.sub)
normal_velocity = lambda a, b, normal: dot(relative_velocity(a, b), normal)  # noqa: E731
rebound_velocity = as_arrays(lambda u, e: np.where(u < 0, -e * u, u))


@as_arrays
def classify_contact(normal_velocity, threshold=0.0):
    return (normal_velocity > threshold).astype(int) - (normal_velocity < np.negative(threshold)).astype(int)


@as_arrays
def impulse_of_force(force, time):
    def area(count):
        if count < 2:
            return 0.0 * force[..., 0, :] * time[..., :1]
        span = time[..., count - 1] - time[..., count - 2]
        return area(count - 1) + span[..., None] * (force[..., count - 1, :] + force[..., count - 2, :]) / 2

    return area(force.shape[-2])


def mean_force(momentum_change, duration, other_force=np.zeros(3)):
    per = np.reciprocal(np.asarray(duration, dtype=float))
    return upright(per) * momentum_change - other_force


def direction(vector):
    return vector / np.sqrt(upright(dot(vector, vector)))


@as_arrays
def point_plane_normal(plane_normal, centre_a, centre_b):
    flip = lambda n: n * upright(np.where(dot(n, centre_a) >= dot(n, centre_b), 1, -1))  # noqa: E731
    return composed(flip, direction)(plane_normal)


edge_edge_normal = lambda a, b, *centres: point_plane_normal(np.cross(a, b), *centres)  # noqa: E731


@as_arrays
def world_inverse_inertia(inertia, orientation):
    def times(p, q):
        scalar = p[..., 0] * q[..., 0] - dot(p[..., 1:], q[..., 1:])
        vector = p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:] + np.cross(p[..., 1:], q[..., 1:])
        return np.concatenate([scalar[..., None], vector], axis=-1)

    def turned(axis, q):
        pure = np.broadcast_to(np.concatenate([[0.0], axis]), q.shape)
        return times(times(q, pure), q * np.array([1, -1, -1, -1]))[..., 1:]

    share = np.where(inertia > 0, 1 / np.where(inertia > 0, inertia, 1.0), 0.0)
    parts = []
    for place, axis in enumerate(np.eye(3)):
        lies = turned(axis, orientation)
        parts.append(share[..., place, None, None] * lies[..., :, None] * lies[..., None, :])
    return functools.reduce(np.add, parts)


def _gain(normal):
    def of(body):
        (dv, dw), arm = on_a((0.0, 0.0, *body[2:]), normal), body[2]
        return dot(normal, point_velocity(dv, dw, arm))

    return of


def inverse_effective_mass(body_a, body_b, normal):
    return sum(map(_gain(normal), (body_a, body_b)))


def _closing(body_a, body_b, normal):
    a, b = (point_velocity(v, w, r) for v, w, r, *_ in (body_a, body_b))
    return normal_velocity(a, b, normal)


def impulse_magnitude(body_a, body_b, normal, restitution):
    k, u = inverse_effective_mass(body_a, body_b, normal), _closing(body_a, body_b, normal)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(k > 1e-12, np.negative(np.add(1, restitution)) * u / k, 0.0)


contact_impulses = lambda magnitude, normal: tuple(  # noqa: E731
    sign * upright(np.asarray(magnitude)) * normal for sign in (1, -1)
)


def apply_impulse(body_a, body_b, impulse):
    (v_a, w_a), (v_b, w_b) = on_a(body_a, impulse), on_b(body_b, np.asarray(impulse))
    return v_a, w_a, v_b, w_b


def apply_impulse_to_momenta(*given):
    *momenta, arm, impulse = given
    return tuple(map(np.add, momenta, (impulse, np.cross(arm, impulse))))


def velocities_from_momenta(momentum, angular_momentum, inverse_mass, inverse_inertia):
    return upright(np.asarray(inverse_mass)) * momentum, np.matvec(inverse_inertia, angular_momentum)


def collide(body_a, body_b, normal, restitution, threshold=0.0):
    colliding = classify_contact(_closing(body_a, body_b, normal), threshold) == -1
    j = impulse_magnitude(body_a, body_b, normal, restitution)
    return apply_impulse(body_a, body_b, upright(np.where(colliding, j, 0.0)) * normal)
