"""Known mistakes of impacts with friction, and of impacts in a row."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import along, col, direction, dot, flat, over, size


def times(matrix, vector):
    return np.matvec(matrix, vector)


def solve(matrix, vector):
    return np.linalg.solve(matrix, np.asarray(vector)[..., None])[..., 0]


def grip_of(u, n, k, e):
    return solve(k, -np.asarray(u) - col(e) * dot(u, n) * n)


def impulse(u, n, k, e, mu, grip=grip_of, limit=None, slip=None, guard=lambda u_n: u_n < 0):
    """Grip, or slip at the edge of the cone."""
    n, mu = np.asarray(n), np.asarray(mu)
    j = grip(u, n, k, e)
    across, u_n = along(j, n), dot(u, n)
    most = mu * flat(dot(j, n)) if limit is None else limit(mu, j, n)
    edge = n + col(mu) * direction(across)
    gained = dot(n, times(k, edge))
    slipping = over(-(1 + col(e)) * u_n, gained) * edge if slip is None else slip(u, n, k, e, mu, j)
    return np.where(guard(u_n), np.where(size(across) <= col(most), j, slipping), 0)


def with_(**parts):
    return lambda u, n, k, e, mu: impulse(u, n, k, e, mu, **parts)


def frictionless(u, n, k, e, mu):
    j = over(-(1 + col(e)) * np.minimum(dot(u, n), 0), dot(n, times(k, n)))
    return j * n + 0 * col(mu)


def clamped_grip(u, n, k, e, mu, j):
    """The tangential part cut to the cone, the normal one left as it was for the grip."""
    return dot(j, n) * n + col(mu) * dot(j, n) * direction(along(j, n))


def clamped_components(u, n, k, e, mu, j):
    most = col(mu) * dot(j, n)
    return dot(j, n) * n + np.clip(along(j, n), -most, most)


def one_after_the_other(u, n, k, e, mu, clamp=True):
    """First the normal impulse as without friction, then what stops the slip, cut to μ of it."""
    u, n = np.asarray(u), np.asarray(n)
    j_n = over(-(1 + col(e)) * np.minimum(dot(u, n), 0), dot(n, times(k, n)))
    way = direction(along(u, n))
    wanted = over(size(along(u, n)), dot(way, times(k, way)), 0)
    j_t = np.minimum(wanted, col(mu) * j_n) if clamp else col(mu) * j_n
    return np.where(dot(u, n) < 0, j_n * n - j_t * way, 0)


def against_first_slip(u, n, k, e, mu, j):
    edge = n - col(mu) * direction(along(u, n))
    return over(-(1 + col(e)) * dot(u, n), dot(n, times(k, edge))) * edge


def wrong_way(u, n, k, e, mu, j):
    edge = n - col(mu) * direction(along(j, n))
    return over(-(1 + col(e)) * dot(u, n), dot(n, times(k, edge))) * edge


def without_cone(u, n, k, e, mu, j):
    return j


def nothing_left(u, n, k, e, mu, j):
    return over(-(1 + col(e)) * dot(u, n), dot(n, times(k, n))) * n


def sphere(v, w, n, R, e, mu, share=0.4, arm=-1, slip=1, turning=1, use=None, force=impulse, keep=0):
    """A sphere's impact, with what may be wrong about it."""
    v, w, n, R = np.asarray(v), np.asarray(w), np.asarray(n), col(R)
    share = np.broadcast_to(np.asarray(share if use is None else use + 0 * np.asarray(share)), np.shape(R[..., 0]))
    inertia = col(share) * R**2
    r = arm * R * n
    across = np.cross(-R[..., None] * n[..., None, :], np.eye(3))
    k = np.eye(3) + across @ np.swapaxes(across, -1, -2) / inertia[..., None]
    j = force(v + slip * np.cross(w, r), n, k, e, mu)
    return v + j, w + turning * np.cross(r, j) / inertia if not keep else w + 0 * j


def block(v, w, n, R, e, mu, share=0.4):
    """A sphere so hard to turn that it does not."""
    after, _ = sphere(v, 0 * np.asarray(w), n, R, e, mu, 1e12 + 0 * np.asarray(share))
    return after, w + 0 * np.asarray(v)


def driven_in(v, w, n, R, e, mu, share=0.4):
    after, spin = sphere(v, w, n, R, e, mu, share)
    return 2 * np.asarray(v) - after, spin


def without_inertia(v, w, n, R, e, mu, share=0.4):
    after, spin = sphere(v, w, n, R, e, mu, share)
    return after, w + (spin - w) * col(share) * col(R) ** 2


def without_radius(v, w, n, R, e, mu, share=0.4):
    """I taken for the share alone."""
    after, spin = sphere(v, w, n, R, e, mu, share)
    return after, w + (spin - w) * col(R) ** 2


def unguarded_row(v, mass, e, most=10_000):
    """One pass over all pairs, whether or not they approach."""
    return row(v, mass, e, most=1, guard=False)


def row(
    v,
    mass,
    e,
    most=10_000,
    guard=True,
    backwards=False,
    both=None,
    weight=None,
    factor=lambda e: 1 + e,
    old=False,
    moved=lambda share: share,
):
    v = np.array(v, dtype=float)
    count = v.shape[-1]
    share = np.broadcast_to(1 / np.asarray(mass, dtype=float), count)
    share = share if weight is None else np.broadcast_to(weight(share), count)
    e = np.broadcast_to(np.asarray(e, dtype=float), max(count - 1, 0))
    for _ in range(min(most, 200)):
        before = v.copy()
        for i in reversed(range(count - 1)) if backwards else range(count - 1):
            seen = before if old else v
            closing = seen[..., i] - seen[..., i + 1]
            j = factor(e[i]) * (np.maximum(0, closing) if guard else closing) / (share[i] + share[i + 1])
            v[..., i] -= j * moved(share[i])
            v[..., i + 1] += (both or 1) * j * moved(share[i + 1])
        if np.array_equal(v, before):
            break
    return v


def swapped(v, mass, e, most=10_000):
    """The faster one of two gives its velocity to the next."""
    v = np.array(v, dtype=float)
    return np.sort(v, axis=-1)


# fmt: off
BANK = (
    M("sphere_grips", "a sliding block", lambda s, v, e, mu: s <= mu * (1 + np.asarray(e)) * v,
      "The ball is treated as a block that slides. The same impulse that brakes the ball also spins it, and both take "
      "away slip: the factor that comes from the inertia is forgotten.",
      "What does friction do to a ball besides slowing it down?"),
    M("sphere_grips", "spin alone", lambda s, v, e, mu: s <= 2.5 * mu * (1 + np.asarray(e)) * v,
      "The factor is 5/2, which is the spin's share alone; the ball's way changes as well. "
      "(Or it is that of a hollow sphere.)",
      "Which two motions make up the slip of the point of contact?"),
    M("sphere_grips", "2/7", lambda s, v, e, mu: s <= 2 / 7 * mu * (1 + np.asarray(e)) * v,
      "The factor is upside down: 2/7 instead of 7/2.",
      "Does turning make it easier or harder to stop the slip?"),
    M("sphere_grips", "7/5", lambda s, v, e, mu: s <= 1.4 * mu * (1 + np.asarray(e)) * v,
      "7/5 belongs to a ball that rolls, m + I/R². At the contact the two shares add up as 1 + 5/2.",
      "By how much does a unit impulse change the velocity of the point of contact?"),
    M("sphere_grips", "restitution left out", lambda s, v, e, mu: s <= 3.5 * mu * v + 0 * np.asarray(e),
      "The impulse is taken without the rebound: it is m (1 + e) v_n.",
      "Which argument makes no difference to your answer?"),
    M("sphere_grips", "turned round", lambda s, v, e, mu: s > 3.5 * mu * (1 + np.asarray(e)) * v,
      "It is true where the ball slips.",
      "No slip at all: does it grip?"),
    M("sphere_grips", "not at the limit", lambda s, v, e, mu: s < 3.5 * mu * (1 + np.asarray(e)) * v,
      "At exactly the limit it says no; friction can just stop the slip there, and no slip needs no friction.",
      "Is a ball without slip gripping?"),
    M("sphere_grips", "1 − e", lambda s, v, e, mu: s <= 3.5 * mu * (1 - np.asarray(e)) * v,
      "1 − e stands in place of 1 + e: a perfect bounce would press not at all.",
      "How large is the impulse along the normal?"),
    M("sphere_grips", "friction left out", lambda s, v, e, mu: s <= 3.5 * (1 + np.asarray(e)) * v + 0 * np.asarray(mu),
      "The coefficient of friction makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("sphere_grips", "e for 1 + e", lambda s, v, e, mu: s <= 3.5 * mu * np.asarray(e) * v,
      "e stands in place of 1 + e: only the rebound is counted, not the stop before it.",
      "How large is the impulse along the normal when e = 0?"),
    M("sphere_grips", "approach speed left out",
      lambda s, v, e, mu: s <= 3.5 * mu * (1 + np.asarray(e)) + 0 * np.asarray(v),
      "The approach speed makes no difference: a speed is compared with a number without a unit.",
      "Which argument makes no difference to your answer?"),
    M("friction_impulse", "no friction", frictionless,
      "Friction makes no difference: the impulse is along the normal alone.",
      "Which argument makes no difference to your answer?"),
    M("friction_impulse", "always grips", with_(slip=without_cone),
      "The slip is always stopped, however large: the cone is not looked at.",
      "How large can friction be beside the normal impulse?"),
    M("friction_impulse", "grip cut to the cone", with_(slip=clamped_grip),
      "Where it slips, the grip's impulse along the surface is cut to μ times the normal one, "
      "and the normal one is left as it was. "
      "With less friction another normal impulse is needed: Newton's rule is broken.",
      "What is the normal velocity after your impulse?"),
    M("friction_impulse", "one after the other", one_after_the_other,
      "The normal impulse is found as without friction, and then the slip is stopped on its own. "
      "Where K couples the directions, each of them changes what the other one had put right.",
      "What is the normal velocity after both of your impulses?"),
    M("friction_impulse", "always slips", lambda *given: one_after_the_other(*given, clamp=False),
      "Friction always has the size μ j, even where less would stop the slip: it throws the slip back.",
      "A very small slip and a lot of friction: what should be left?"),
    M("friction_impulse", "against the first slip", with_(slip=against_first_slip),
      "Friction acts against the slip before the impact; it is to act along the grip's impulse, "
      "which a K that couples the directions turns away from there.",
      "Which direction does the description give to the impulse along the surface?"),
    M("friction_impulse", "along the slip", with_(slip=wrong_way),
      "Where it slips friction drives the slip instead of braking it.",
      "Which way does friction point?"),
    M("friction_impulse", "no friction where it slips", with_(slip=nothing_left),
      "Where it slips there is no friction at all; it still gives as much as it can.",
      "How large is friction at the edge of the cone?"),
    M("friction_impulse", "no restitution", with_(grip=lambda u, n, k, e: solve(k, -np.asarray(u)) + 0 * col(e)),
      "The grip stops the approach but does not turn it round: e is missing.",
      "What should the normal velocity be after the impact?"),
    M("friction_impulse", "slip thrown back too", with_(grip=lambda u, n, k, e: solve(k, -(1 + col(e)) * u)),
      "e is applied to the whole velocity: the slip is thrown back as well. The grip is to stop it.",
      "What should the slip be after a grip?"),
    M("friction_impulse", "sign", lambda *given: -impulse(*given),
      "The impulse is the one on B: on A it has the other sign.",
      "Which way must A be pushed, with the normal from B to A?"),
    M("friction_impulse", "no guard", with_(guard=lambda u_n: np.isfinite(u_n)),
      "Bodies that move apart get an impulse as well.",
      "What should come out where the bodies do not approach?"),
    M("friction_impulse", "guard turned round", with_(guard=lambda u_n: u_n > 0),
      "The guard is the wrong way round: bodies that approach go through.",
      "Which sign has u·n of bodies that come nearer?"),
    M("friction_impulse", "limit without the normal impulse", with_(limit=lambda mu, j, n: mu + 0 * flat(dot(j, n))),
      "The impulse along the surface is compared with μ alone; the limit is μ times the normal impulse.",
      "What unit has μ?"),
    M("friction_impulse", "K for its inverse",
      with_(grip=lambda u, n, k, e: times(k, -np.asarray(u) - col(e) * dot(u, n) * n)),
      "The velocity is multiplied with K; K J = Δu has to be solved for J.",
      "What unit has K times a velocity?"),
    M("friction_impulse", "limit of each component",
      with_(slip=clamped_components),
      "Each component along the surface is cut on its own: the cone is round.",
      "How large is friction along the diagonal?"),
    M("friction_impulse", "always at the cone's edge", with_(limit=lambda mu, j, n: -1 + 0 * flat(dot(j, n))),
      "It always slips: the impulse is at the edge of the cone even where less stops the slip.",
      "A very small slip and a lot of friction: what should be left?"),
    M("sphere_impact", "no friction",
      lambda v, w, n, R, e, mu, share=0.4: sphere(v, w, n, R, e, 0 * np.asarray(mu), share),
      "Friction makes no difference: spin and way go on as they were.",
      "Which argument makes no difference to your answer?"),
    M("sphere_impact", "spin does not slip", lambda *given: sphere(*given, slip=0),
      "The spin makes no difference to the slip: the point of contact is taken to move as the centre does.",
      "How does the lowest point of a spinning ball move?"),
    M("sphere_impact", "arm the wrong way", lambda *given: sphere(*given, arm=1),
      "The arm points from the contact to the centre: it should point from the centre to the contact, −R n.",
      "Where is the contact, seen from the centre?"),
    M("sphere_impact", "spin keeps on", lambda *given: sphere(*given, keep=1),
      "The spin comes back unchanged: friction turns the ball as well.",
      "Where does friction act? Has it an arm?"),
    M("sphere_impact", "spin turned the wrong way", lambda *given: sphere(*given, turning=-1),
      "The change of the spin has the wrong sign: J × r in place of r × J.",
      "A ball slides to the right on the floor. Which way does friction make it turn?"),
    M("sphere_impact", "slip the wrong way", lambda *given: sphere(*given, slip=-1),
      "The velocity of the point of contact is v − ω × r in place of v + ω × r.",
      "A ball rolls. Which velocity has its lowest point?"),
    M("sphere_impact", "a solid cylinder", lambda *given: sphere(*given[:6], use=0.5),
      "The share 1/2 is that of a cylinder, and the one given makes no difference.",
      "What is the moment of inertia of a sphere?"),
    M("sphere_impact", "a solid sphere always", lambda *given: sphere(*given[:6]),
      "It is always a solid sphere: the share of inertia given makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("sphere_impact", "inertia left out", without_inertia,
      "The change of the spin is r × J: it is not divided by the moment of inertia.",
      "What does a torque's impulse change directly, and what through the inertia?"),
    M("sphere_impact", "radius squared left out", without_radius,
      "The share is taken for the moment of inertia: it has to be multiplied with m R².",
      "What unit has a moment of inertia?"),
    M("sphere_impact", "always grips", lambda *given: sphere(*given, force=with_(slip=without_cone)),
      "The slip is always stopped, however large.",
      "How large can friction be beside the normal impulse?"),
    M("sphere_impact", "always slips",
      lambda *given: sphere(*given, force=lambda *g: one_after_the_other(*g, clamp=False)),
      "Friction always has the size μ j, even where less would stop the slip.",
      "A very small slip and a lot of friction: what should be left?"),
    M("sphere_impact", "a block",
      block,
      "The ball is treated as a block that cannot turn.",
      "What does friction do to a ball besides slowing it down?"),
    M("sphere_impact", "no guard", lambda *given: sphere(*given, force=with_(guard=lambda u_n: np.isfinite(u_n))),
      "A ball that moves away gets an impulse as well.",
      "What should become of a ball that is leaving?"),
    M("sphere_impact", "perfect bounce",
      lambda v, w, n, R, e, mu, share=0.4: sphere(v, w, n, R, 1 + 0 * np.asarray(e), mu, share),
      "Every bounce is perfect: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("sphere_impact", "radius not squared",
      lambda v, w, n, R, e, mu, share=0.4: sphere(v, w, n, R, e, mu, share / np.asarray(R)),
      "The moment of inertia is taken as a share of m R: the radius is to be squared.",
      "What unit has a moment of inertia?"),
    M("sphere_impact", "impulse taken away",
      driven_in,
      "The impulse is taken away from the velocity: the ball goes on into the plane.",
      "Which way must the ball be pushed?"),
    M("propagate_impacts", "one pass", lambda v, m, e, most=1: row(v, m, e, most=1),
      "The pairs are gone through once; some of them approach again afterwards.",
      "Is there a pair left that approaches?"),
    M("propagate_impacts", "no guard", unguarded_row,
      "Every pair collides, also one that moves apart.",
      "What should happen to two balls that move apart?"),
    M("propagate_impacts", "perfect always", lambda v, m, e, most=200: row(v, m, e, factor=lambda e: 2),
      "Every impact is perfect: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("propagate_impacts", "e for 1 + e", lambda v, m, e, most=200: row(v, m, e, factor=lambda e: e),
      "e stands in place of 1 + e: the balls go on into each other.",
      "How large must the impulse be to bring two balls to the same speed? And how much more to part them?"),
    M("propagate_impacts", "equal masses", lambda v, m, e, most=200: row(v, 1.0, e),
      "All balls are taken to have the same mass.",
      "Which argument makes no difference to your answer?"),
    M("propagate_impacts", "mass for its inverse",
      lambda v, m, e, most=200: row(v, m, e, weight=lambda s: np.where(s > 0, 1 / np.where(s > 0, s, 1), 1e9)),
      "The velocities change by the impulse times the mass; a heavy ball should change less.",
      "A marble hits a cannon ball. Which one flies off?"),
    M("propagate_impacts", "+J to both", lambda v, m, e, most=200: row(v, m, e, both=-1, most=50),
      "The impulse acts the same way on both balls: momentum is not conserved.",
      "What does Newton's third law say of the two?"),
    M("propagate_impacts", "all at once", lambda v, m, e, most=200: row(v, m, e, old=True),
      "All pairs of a pass use the velocities from before it: a ball between two others gets both impulses at once.",
      "After the first pair has collided, which velocity has the second ball?"),
    M("propagate_impacts", "from the right", lambda v, m, e, most=200: row(v, m, e, backwards=True),
      "The pairs are gone through from the right; the description starts on the left, and the order matters.",
      "Which pair comes first?"),
    M("propagate_impacts", "sorted", swapped,
      "The velocities are sorted: right for equal, perfectly elastic balls only.",
      "Which arguments make no difference to your answer?"),
    M("propagate_impacts", "no rebound", lambda v, m, e, most=200: row(v, m, e, factor=lambda e: 1),
      "The balls only come to the same speed: no impact has a rebound.",
      "Which argument makes no difference to your answer?"),
    M("propagate_impacts", "1 − e", lambda v, m, e, most=200: row(v, m, e, factor=lambda e: 1 - e),
      "1 − e stands in place of 1 + e: with e = 1 nothing happens at all.",
      "What should two equal balls do with e = 1?"),
)
# fmt: on
