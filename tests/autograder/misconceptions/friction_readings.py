"""Loose readings of the slides about friction: the limit as a value, and masses and shares that are forgotten."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, direction, dot, formulas_of, over, size

DRY, IMPACTS = formulas_of("friction"), formulas_of("friction_impacts")
sphere, row = IMPACTS.sphere, IMPACTS.row


def always_static(push, v, N, s, k):
    """−μ_s N along the velocity or, at rest, along the push."""
    way = np.where(size(v) > 0, direction(v), direction(push))
    return -col(s * np.asarray(N)) * way + 0 * col(k)


def whole_step_after_the_stop(p, v, f, N, s, k, m, dt):
    """From where it stops, a whole step more."""
    place, speed, time = DRY.slide(p, v, f, N, s, k, m, dt)
    after = (f + DRY.friction(f, 0 * np.asarray(v), N, s, k)) / col(m)
    dt = col(dt)
    stopped = col(time) <= dt
    rest = np.where(stopped, dt - col(np.where(np.isfinite(time), time, 0)), 0)
    extra = np.where(stopped, after * (dt**2 - rest**2) / 2, 0)
    return place + extra, speed + np.where(stopped, after * (dt - rest), 0), time


def separately(mass_of):
    """Normal and tangential impulse each for itself, with an inverse mass for either: (along n, along the slip)."""

    def impulse(u, n, k, e, mu):
        u, n = np.asarray(u), np.asarray(n)
        u_n, slip = np.minimum(dot(u, n), 0), u - dot(u, n) * n
        along_normal, along_slip = mass_of(n, k)
        j_n = over(-(1 + col(e)) * u_n, along_normal, 0)
        j_t = np.minimum(over(size(slip), along_slip, 0), col(mu) * j_n)
        return j_n * n - j_t * direction(slip)

    return impulse


def normal_mass(n, k):
    """n·K n for both."""
    found = dot(n, np.matvec(k, n))
    return found, found


def no_mass(n, k):
    return np.ones(1), np.ones(1)


def normal_mass_alone(n, k):
    return dot(n, np.matvec(k, n)), np.ones(1)


def slip_thrown_back(u, n, k, e, mu):
    return IMPACTS.impulse(u, n, k, e, mu, grip=lambda u, n, k, e: IMPACTS.solve(k, -(1 + col(e)) * u))


def sphere_turned_back(v, w, n, R, e, mu, share=0.4):
    """−e v of a sphere that approaches; the spin stays."""
    v, unused = np.asarray(v), col(R) + col(mu) + col(share)
    return np.where(dot(v, n) < 0, -col(e) * v, v) + 0 * unused, np.asarray(w) + 0 * unused


def row_without_mass(v, m, e, most=200):
    """The impulse itself is taken from one velocity and added to the other."""
    return row(v, m, e, most=most, moved=lambda share: 1 + 0 * share)


# fmt: off
BANK = (
    M("friction_force", "limit while held", DRY.of(rest=lambda f, v, N, s, k: -col(s * N) * direction(f)),
      "A body that is held gets μ_s N, as slide 24 prints it. That is only the largest value of static friction: "
      "with a gentle push, friction would win and set the body in motion against the push.",
      "Push a heavy box with one finger. How large is the friction, if the box stays where it is?"),
    M("friction_force", "static throughout", always_static,
      "Friction is μ_s N always, at rest and while the body slides. "
      "Slide 24 has two coefficients, and the static one only gives the largest value for a body at rest.",
      "Which argument does your answer not depend on? And how large is the friction on a box that nobody pushes hard?"),
    M("sliding_motion", "a whole step after the stop", whole_step_after_the_stop,
      "After the stop the body moves for a whole Δt. Only the rest of the step is left by then.",
      "How much time has passed when your function returns?"),
    M("friction_impulse", "no mass", separately(no_mass),
      "The change of velocity is returned as the impulse: K, the inverse mass of the two bodies, is not used. "
      "Slide 13 has J = M Δv.",
      "What unit does your result have?"),
    M("friction_impulse", "the normal's mass for the slip", separately(normal_mass),
      "The slip is stopped with the same effective mass as the approach. "
      "Along the surface a body gives way differently, because the impulse there also turns it.",
      "By how much does an impulse along the surface change the slip of a ball? And one along the normal?"),
    M("friction_impulse", "no mass for the slip", separately(normal_mass_alone),
      "The impulse that stops the slip is taken to be the slip itself: its effective mass is forgotten. "
      "Along the normal the effective mass is there.",
      "What unit does the part of your impulse along the surface have?"),
    M("sphere_impact", "grip without the turning", lambda *given: sphere(*given, force=separately(no_mass)),
      "The impulse that stops the slip is taken to be m times the slip, as for a block. "
      "A sphere also starts to spin, which takes away a part of the slip. "
      "The factor that comes from its inertia is forgotten.",
      "Which two motions make up the slip of the point of contact? What does the impulse do to each of them?"),
    M("sphere_impact", "slip thrown back too", lambda *given: sphere(*given, force=slip_thrown_back),
      "e is applied to the whole velocity of the point of contact, so that the slip is thrown back as well. "
      "Slide 12 uses e for the component along the normal, and friction can at most stop the slip.",
      "What should the slip be after a grip?"),
    M("sphere_impact", "whole velocity turned", sphere_turned_back,
      "The whole velocity is reversed and scaled by e, and friction is not used. "
      "Restitution is about the component along the normal alone.",
      "Which component does restitution speak of? And which arguments does your answer not depend on?"),
    M("propagate_impacts", "no mass", row_without_mass,
      "The impulse itself is taken from one velocity and added to the other. Slide 13 has J = M Δv.",
      "A marble and a cannon ball get the same impulse. Do their velocities change by the same amount?"),
    M("resting_problem", "no mass", lambda g, w, f: (g @ np.swapaxes(g, -1, -2) + 0 * (g @ w @ np.swapaxes(g, -1, -2)),
                                                     np.matvec(g + 0 * (g @ w), f)),
      "The inverse masses are used nowhere: A is G Gᵀ, and b is G F.",
      "Which argument does your answer not depend on? And what unit does each of your results have?"),
)
# fmt: on
