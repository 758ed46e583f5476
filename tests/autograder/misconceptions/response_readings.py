"""Loose readings about the response: vectors reversed as a whole, frames and times mixed up, endless contacts."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, dot, formulas_of

RESPONSE, PENALTY = formulas_of("response"), formulas_of("response_penalty")
STILL, seen, flight, respond, split, struck, at_step, within, pressing = (
    getattr(RESPONSE, name)
    for name in ("STILL", "seen", "flight", "respond", "split", "struck", "at_step", "within", "pressing")
)
bounced_back = split(lambda e: -1 + 0 * e, lambda e: -1 + 0 * e)


def thrown_back(v, n, e):
    """−e v of every velocity, whichever way it goes."""
    return -col(e) * v + 0 * np.asarray(n)


def turned_back(v, n, e):
    """−v of every velocity."""
    return -np.asarray(v) + 0 * np.asarray(n) + 0 * col(e)


def where_it_gains(answer):
    """An answer where the plane gains on the body; everything else keeps its velocity."""
    return lambda v, n, e, w=STILL: np.where(dot(np.asarray(v) - w, n) < 0, answer(v, w, col(e)), v)


def in_the_middle(p, v, a, n, e, T, dt):
    return struck(p, v, a, n, e, np.where(np.less_equal(T, dt), dt / 2, T), dt)


def step_before_the_impact(p, v, a, n, e, T, dt):
    """The whole step, the response, and then the rest of the step again."""
    p, v = flight(p, v, a, dt + 0 * np.minimum(T, 1))
    hit = np.less_equal(T, dt)
    return flight(p, np.where(col(hit), respond(v, n, e), v), a, np.where(hit, dt - np.minimum(T, dt), 0))


def gaining(v, w, n):
    return dot(np.asarray(v) - w, n) < 0


def left_in_the_planes_frame(v, n, e, w=STILL):
    return np.where(gaining(v, w, n), respond(np.asarray(v) - w, n, e), v)


def planes_velocity_once(v, n, e, w=STILL):
    return np.where(gaining(v, w, n), v - (1 + col(e)) * dot(v, n) * n + dot(w, n) * n, v)


def carried_after(p, v, a, n, e, T, dt):
    """From the impact on, the plane carries the weight."""
    hit = col(np.less_equal(T, dt))
    return struck(p, v, a, n, e, T, dt, glide=lambda a: np.where(hit, a - pressing(a, n), a))


def share_of_the_step(p, v, a, n, e, T, dt):
    return struck(p, v, a, n, e, np.where(np.asarray(T) <= 1, T * np.asarray(dt), np.inf), dt)


# Penalty


def without_an_end(s, v, n, k, c=0.0, adhesive=False):
    """The contact of two bodies that have come apart, if it may pull."""
    touching = (lambda s: np.full(np.shape(s), True)) if adhesive else (lambda s: np.asarray(s) < 0)
    return PENALTY.pushing(PENALTY.right, inside=touching)(s, v, n, k, c, adhesive)


def by_components(s, v, n, k, c=0.0, adhesive=False):
    force = PENALTY.pushing(PENALTY.right, clamp=False)(s, v, n, k, c, adhesive)
    return force if adhesive else np.maximum(force, 0)


def damped_frequency(m, k, c=0.0):
    squared = np.asarray(k) / m - (c / (2 * np.asarray(m))) ** 2
    return np.where(squared > 0, 2 / np.sqrt(np.where(squared > 0, squared, 1.0)), np.inf)


def nearly_equal(m, k, c=0.0):
    return (np.sqrt(np.asarray(c) ** 2 + 4 * np.asarray(m) * k) - c) / k


def zero_mended(m, k, c=0.0):
    """The difference, and 2 m/c only where no digit of it is left."""
    found = nearly_equal(m, k, c)
    return np.where(found > 0, found, 2 * np.asarray(m) / np.where(np.asarray(c) > 0, c, 1.0))


# fmt: off
BANK = (
    M("kinematic_response", "left in the plane's frame", left_in_the_planes_frame,
      "Where they approach, the result is the velocity as seen from the plane, and everywhere else the velocity as seen"
      " from the ground. The way back from the plane's frame is missing.",
      "A ball does not bounce at all and stays with the racket. How fast is it, seen from the ground?"),
    M("kinematic_response", "plane's velocity once, where it gains", planes_velocity_once,
      "The plane's velocity is added to the bounce off a plane at rest. It should come in 1 + e times, "
      "through the relative velocity.",
      "Perfect bounce: a ball at rest is met by a racket at speed w. How fast is it afterwards, seen from the racket?"),
    M("respond_at_impact", "weight carried after", carried_after,
      "After the impact the plane goes on carrying the weight, as it does for one step where the response comes at time"
      " steps. Here the ball has left the plane, and its weight pulls it down.",
      "What touches the ball after the bounce?"),
    M("respond_at_impact", "T = 0 is no impact", lambda *given: struck(*given[:5], np.where(
        np.asarray(given[5]) > 0, given[5], np.inf), given[6]),
      "An impact at the very start of the step is not answered, and the body goes on into the plane.",
      "A ball lies on the plane and moves into it. At which T does it strike?"),
    M("respond_at_impact", "T for a share", share_of_the_step,
      "The time of impact is taken for a share of the step, from 0 to 1. It is a time.",
      "In which unit is T given?"),
    M("penalty_force", "damping weakens", PENALTY.pushing(lambda s, v, k, c: -k * s - c * np.abs(v)),
      "The dashpot makes the push weaker whichever way the body moves. It resists the motion, and so it has to push"
      " more while the body moves in.",
      "The body moves in. Which way does a force point that resists this?"),
    M("penalty_force", "adhesion without an end", without_an_end,
      "With adhesion the contact never ends: a body that has come off is still pulled back.",
      "Up to which separation is there a contact, adhesive or not?"),
    M("penalty_force", "components clamped", by_components,
      "Each component of the force is clamped by itself. Whether the contact pulls is to be asked of the force along"
      " the normal.",
      "A wall has the normal (0, −1, 0). Which sign has the y component of a force that pushes off this wall?"),
    M("penalty_step_limit", "damped frequency", damped_frequency,
      "The frequency of the damped swing is put into 2/ω. It says how the body moves. Which step the method can bear is"
      " another question, and damping makes this step shorter.",
      "What does your limit say of a contact that does not swing at all? Try such a step."),
    M("penalty_step_limit", "smaller of two limits", PENALTY.limit(lambda w, z, m, c: np.minimum(
        2 / w, np.divide(1, z * w))),
      "The spring and the dashpot have a limit each, and the smaller one is taken. They act together, and allow less"
      " than either of them alone.",
      "Make a step of the smaller of your two limits with ζ = 1/2. Does the contact come to rest?"),
    M("penalty_step_limit", "digits lost", nearly_equal,
      "With a strong damper two nearly equal numbers are subtracted, and no digit of their difference is left.",
      "What is √(1 + x²) − x for x = 10⁹ on your computer? Which form of it does without a difference?"),
    M("penalty_step_limit", "digits lost, zero mended", zero_mended,
      "With a strong damper two nearly equal numbers are subtracted. Where their difference is zero it is replaced, but"
      " before that it has lost most of its digits.",
      "What is √(1 + x²) − x for x = 10⁷ on your computer, and what is 1/(2 x)? Which form of it does without a"
      " difference?"),
    M("kinematic_response", "whole velocity turned, no guard", seen(thrown_back),
      "The whole velocity is reversed and scaled by e, and nothing asks whether the body approaches. "
      "Slide 7 changes only the component along the normal.",
      "Draw a ball that hits the floor at a slant, and one that has just left it. Which component changes, and when?"),
    M("kinematic_response", "sent back the way it came", seen(bounced_back),
      "The whole velocity is reversed, and the restitution is not used. "
      "Slide 7 changes only the component along the normal.",
      "Draw a ball that hits the floor at a slant. Does it come back to your hand? And where does e come in?"),
    M("kinematic_response", "sent back the way it came, no guard", seen(turned_back),
      "Every velocity is reversed as a whole: neither the normal nor the restitution is used. "
      "Slide 7 changes only the component along the normal, and only a body that approaches needs an answer.",
      "Which arguments does your answer not depend on?"),
    M("kinematic_response", "whole velocity turned, in the plane's frame",
      where_it_gains(lambda v, w, e: -e * (np.asarray(v) - w)),
      "The whole relative velocity is reversed and scaled, and the result is left in the plane's frame. "
      "Slide 7 changes only the component along the normal.",
      "In whose frame is your answer? And which component does restitution speak of?"),
    M("kinematic_response", "body's velocity turned", where_it_gains(lambda v, w, e: -e * v + 0 * np.asarray(w)),
      "The body's own velocity is reversed as a whole and scaled by e, as if the plane were at rest. "
      "Slide 7 changes only the component along the normal, and here that component is relative to the plane.",
      "A ball at rest is met by a racket. Where is it afterwards?"),
    M("respond_at_impact", "whole velocity turned, no guard", lambda *given: struck(*given, answer=thrown_back),
      "At the impact the whole velocity is reversed and scaled by e, whichever way it points. "
      "Slide 7 changes only the component along the normal.",
      "Which component does restitution speak of? And what of a body that moves away at that instant?"),
    M("respond_at_impact", "sent back the way it came", lambda *given: struck(*given, answer=bounced_back),
      "At the impact the whole velocity is reversed, and the restitution is not used. "
      "Slide 7 changes only the component along the normal.",
      "Draw a ball that hits the floor at a slant. Does it come back to your hand?"),
    M("respond_at_impact", "middle of the step", in_the_middle,
      "The response comes in the middle of the step. Slide 6 backs up to the time of impact, which is an argument.",
      "Two balls reach the floor, one early in the step and one late. Does your function tell them apart?"),
    M("respond_at_impact", "Δt for T", step_before_the_impact,
      "The body moves for the whole Δt before the response. Slide 6 backs up to T, the time of impact.",
      "Where is the body when you respond? And how much time has passed when your function returns?"),
    M("respond_at_step", "whole velocity turned, no guard",
      lambda *given: at_step(*given, answer=thrown_back, when=within),
      "Behind the plane the whole velocity is reversed and scaled by e, whichever way it points. "
      "Slide 7 changes only the component along the normal.",
      "Which component does restitution speak of? And what of a body that is on its way out?"),
    M("respond_at_step", "sent back the way it came", lambda *given: at_step(*given, answer=bounced_back),
      "Behind the plane the whole velocity is reversed, and the restitution is not used. "
      "Slide 7 changes only the component along the normal.",
      "Draw a ball that hits the floor at a slant. Does it come back to your hand?"),
)
# fmt: on
