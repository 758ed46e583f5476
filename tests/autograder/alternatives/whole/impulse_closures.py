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
minus = as_arrays(operator.sub)
normal_velocity = lambda a, b, normal: dot(  # noqa: E731
    minus(*(point_velocity(v, w, r) for v, w, r, *_ in (a, b))), normal
)


@as_arrays
def classify_contact(normal_velocity, threshold=0.0):
    return (normal_velocity > threshold).astype(int) - (normal_velocity < np.negative(threshold)).astype(int)


def direction(vector):
    return vector / np.sqrt(upright(dot(vector, vector)))


@as_arrays
def towards_a(normal, centre_a, centre_b):
    flip = lambda n: n * upright(np.where(dot(n, centre_a) >= dot(n, centre_b), 1, -1))  # noqa: E731
    return composed(flip, direction)(normal)


edge_edge_normal = lambda a, b, *centres: towards_a(np.cross(a, b), *centres)  # noqa: E731


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


def impulse_magnitude(body_a, body_b, normal, restitution):
    k, u = inverse_effective_mass(body_a, body_b, normal), normal_velocity(body_a, body_b, normal)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(k > 1e-12, np.negative(np.add(1, restitution)) * u / k, 0.0)


def apply_impulse(body_a, body_b, impulse):
    (v_a, w_a), (v_b, w_b) = on_a(body_a, impulse), on_b(body_b, np.asarray(impulse))
    return v_a, w_a, v_b, w_b


def collide(body_a, body_b, normal, restitution, threshold=0.0):
    colliding = classify_contact(normal_velocity(body_a, body_b, normal), threshold) == -1
    j = impulse_magnitude(body_a, body_b, normal, restitution)
    return apply_impulse(body_a, body_b, upright(np.where(colliding, j, 0.0)) * normal)


def _of(body, velocity, spin):
    _, _, arm, share, turning = body
    mass = np.where(share > 0, 1 / np.where(share > 0, share, 1.0), 0.0)
    momentum, own = upright(mass) * velocity, np.matvec(np.linalg.pinv(turning, rcond=1e-10), spin)
    return momentum, own - np.cross(arm, momentum), (dot(momentum, velocity) + dot(own, spin)) / 2


@as_arrays
def audit(body_a, body_b, after):
    v_a, w_a, v_b, w_b = after
    change = lambda body, v, w: map(operator.sub, _of(body, v, w), _of(body, *body[:2]))  # noqa: E731
    return tuple(map(operator.add, change(body_a, v_a, w_a), change(body_b, v_b, w_b)))
