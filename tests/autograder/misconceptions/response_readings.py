"""Loose readings of the slides about the response: the whole vector reversed, and times within the step mixed up."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, dot, formulas_of

RESPONSE = formulas_of("response")
STILL, seen, flight, respond, split, struck, at_step, within = (
    getattr(RESPONSE, name) for name in ("STILL", "seen", "flight", "respond", "split", "struck", "at_step", "within")
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


# fmt: off
BANK = (
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
