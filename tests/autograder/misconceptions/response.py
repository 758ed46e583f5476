"""Known mistakes in responding to a collision with a plane by a new velocity."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, dot, size


def closing(v, n):
    return np.minimum(dot(v, n), 0)


def respond(v, n, e):
    return v - (1 + col(e)) * closing(v, n) * n


def flight(p, v, a, t):
    t = col(t)
    return p + v * t + a * t**2 / 2, v + a * t


STILL = (0.0, 0.0, 0.0)


def seen(answer):
    """The answer of a plane at rest, as it is seen from a plane that moves."""
    return lambda v, n, e, w=STILL: w + answer(np.asarray(v) - w, n, e)


def at_rest(answer):
    """The answer of a plane at rest, also where the plane moves."""
    return lambda v, n, e, w=STILL: answer(np.asarray(v), n, e) + 0 * np.asarray(w)


def split(kept, turned):
    """Response from what becomes of the two components: factors of (tangent, normal), where it approaches."""

    def response(v, n, e):
        normal = dot(v, n) * n
        e = col(e)
        return np.where(dot(v, n) < 0, kept(e) * (v - normal) + turned(e) * normal, v)

    return response


def axis_only(v, n, e):
    """The floor's response, whatever the normal."""
    after = np.array(np.broadcast_arrays(v, n)[0])
    after[..., 2] = np.where(after[..., 2] < 0, -np.asarray(e) * after[..., 2], after[..., 2])
    return after


def all_at_once(v, n, e):
    """One decision for all contacts of a call."""
    return np.where(np.all(dot(v, n) < 0), v - (1 + col(e)) * dot(v, n) * n, v)


def struck(p, v, a, n, e, T, dt, answer=respond, rest=lambda T, dt: dt - T, glide=lambda a: a, last=np.less_equal):
    hit, before = col(last(T, dt)), np.minimum(T, dt)
    p, v = flight(p, v, a, before)
    v = np.where(hit, answer(v, n, e), v)
    return flight(p, v, glide(a), np.where(last(T, dt), rest(np.where(np.isfinite(T), T, 0), dt), dt - before))


def stops_there(p, v, a, n, e, T, dt):
    hit, before = col(np.less_equal(T, dt)), np.minimum(T, dt)
    p, v = flight(p, v, a, before)
    return p, np.where(hit, respond(v, n, e), v)


def goes_on_unanswered(p, v, a, n, e, T, dt):
    """The end of the free step, with the velocity answered."""
    p, v = flight(p, v, a, dt + 0 * np.minimum(T, 1))
    return p, np.where(col(np.less_equal(T, dt)), respond(v, n, e), v)


def old_velocity(p, v, a, n, e, T, dt):
    """The velocity at the start of the step is the one that is answered."""
    hit, before = col(np.less_equal(T, dt)), np.minimum(T, dt)
    p, at = flight(p, v, a, before)
    return flight(p, np.where(hit, respond(v, n, e), at), a, dt - before)


def always_struck(p, v, a, n, e, T, dt):
    before = np.minimum(T, dt)
    p, v = flight(p, v, a, before)
    return flight(p, respond(v, n, e), a, dt - before)


def euler_to_impact(p, v, a, n, e, T, dt):
    hit, before = col(np.less_equal(T, dt)), np.minimum(T, dt)
    p, v = p + v * col(before), v + a * col(before)
    v, rest = np.where(hit, respond(v, n, e), v), col(dt - before)
    return p + v * rest, v + a * rest


def semi_euler_to_impact(p, v, a, n, e, T, dt):
    hit, before = col(np.less_equal(T, dt)), np.minimum(T, dt)
    v = v + a * col(before)
    p = p + v * col(before)
    v, rest = np.where(hit, respond(v, n, e), v), col(dt - before)
    v = v + a * rest
    return p + v * rest, v


def mirror(v, n, e):
    return v - 2 * closing(v, n) * n + 0 * col(e)


def unguarded(v, n, e):
    return v - (1 + col(e)) * dot(v, n) * n


def unguarded_at(v, n, e, w):
    return v - (1 + col(e)) * dot(np.asarray(v) - w, n) * n


def euler(p, v, a, dt):
    return p + v * col(dt), v + a * col(dt)


def semi_euler(p, v, a, dt):
    return p + (v + a * col(dt)) * col(dt), v + a * col(dt)


def speed_unchanged(p, v, a, dt):
    return semi_euler(p, v, a, dt)[0], v + 0 * col(dt)


def pressing(a, n):
    """The component of the acceleration that presses the body onto the plane."""
    return np.minimum(dot(a, n), 0) * n


def within(behind, v, n):
    """Whether each body is behind the plane, as a column beside its vectors."""
    return col(behind).astype(bool) & (0 * dot(v, n) == 0)


def moves_in(behind, v, n):
    """Whether each body is behind the plane and approaches it."""
    return within(behind, v, n) & (dot(v, n) < 0)


def at_step(p, v, a, n, behind, e, dt, answer=respond, carried=pressing, move=semi_euler, when=moves_in):
    hit = when(behind, v, n)
    return move(p, np.where(hit, answer(v, n, e), v), a - np.where(hit, carried(a, n), 0), dt)


def always_carried(p, v, a, n, behind, e, dt):
    start = np.where(moves_in(behind, v, n), respond(v, n, e), v)
    return semi_euler(p, start, a - pressing(a, n), dt)


def carried_behind(p, v, a, n, behind, e, dt):
    """The weight of every body behind the plane is carried, also of one that is on its way out."""
    start = np.where(moves_in(behind, v, n), respond(v, n, e), v)
    return semi_euler(p, start, a - np.where(within(behind, v, n), pressing(a, n), 0), dt)


def responds_at_the_end(p, v, a, n, behind, e, dt, move=flight):
    p, v = move(p, v, a, dt)
    return p, np.where(moves_in(behind, v, n), respond(v, n, e), v)


def weight_first(p, v, a, n, behind, e, dt):
    """The velocity that gravity has already changed in this step is the one that is answered."""
    v = v + a * col(dt)
    v = np.where(moves_in(behind, v, n), respond(v, n, e), v)
    return p + v * col(dt), v


def moved_unanswered(p, v, a, n, behind, e, dt):
    """The place comes from the velocity before the response."""
    return semi_euler(p, v, a, dt)[0], at_step(p, v, a, n, behind, e, dt)[1]


def step_lost(p, v, a, n, behind, e, dt):
    """A body that responds does not move in that step."""
    after = at_step(p, v, a, n, behind, e, dt)
    return np.where(moves_in(behind, v, n), p + 0 * after[0], after[0]), after[1]


# fmt: off
BANK = (
    M("kinematic_response", "no guard", seen(unguarded),
      "The response is given whether or not the body approaches: the slide has no guard. "
      "A body that is leaving already is thrown back into the plane, and sticks there.",
      "What should become of a body that moves away?"),
    M("kinematic_response", "the slide's mirror", at_rest(lambda v, n, e: v - 2 * dot(v, n) * n + 0 * col(e)),
      "It is the slide's v − 2(v·N)N: every bounce is perfect, there is no guard for a body that moves away, "
      "and the plane is always at rest.",
      "Where do the restitution and the plane's velocity come in? And what of a body that is leaving?"),
    M("kinematic_response", "the slide's mirror, seen from the plane",
      seen(lambda v, n, e: v - 2 * dot(v, n) * n + 0 * col(e)),
      "It is the slide's v − 2(v·N)N, as seen from the plane: every bounce is perfect, "
      "and there is no guard for a body that moves away.",
      "Where does the restitution come in? And what of a body that is leaving?"),
    M("kinematic_response", "always perfect", seen(mirror),
      "Every bounce is perfect, as with the slide's 2: the restitution makes no difference.",
      "The slide's formula is right for one value of e. Which? What takes the place of the 2?"),
    M("kinematic_response", "e for 1 + e", seen(lambda v, n, e: v - col(e) * closing(v, n) * n),
      "e times the normal velocity is taken away. That only slows the body down: it goes on into the plane.",
      "How much has to be taken away to stop it? And how much more to send it back?"),
    M("kinematic_response", "2 e for 1 + e", seen(lambda v, n, e: v - 2 * col(e) * closing(v, n) * n),
      "The slide's 2 was multiplied with e. For e = 1 that is right; for e = 0 the body goes through the plane.",
      "Try e = 0. Where should the normal velocity be afterwards?"),
    M("kinematic_response", "not turned round", seen(lambda v, n, e: v - (1 - col(e)) * closing(v, n) * n),
      "The normal velocity comes out as e times itself, not reversed, "
      "as with 1 − e in place of 1 + e or with the prose of the slides: the body goes on into the plane, "
      "only more slowly.",
      "In which direction should it move afterwards? Try e = 1."),
    M("kinematic_response", "sign of the change", seen(lambda v, n, e: v + (1 + col(e)) * closing(v, n) * n),
      "The change is added where it has to be taken away: the body is driven into the plane faster than it came.",
      "v·N is negative here. Which way does (v·N)N point?"),
    M("kinematic_response", "guard turned round", seen(lambda v, n, e: v - (1 + col(e)) * np.maximum(dot(v, n), 0) * n),
      "The guard is the wrong way round: bodies that move away are answered, bodies that approach go through.",
      "Which sign has v·N of a body that comes nearer, with N out of the plane?"),
    M("kinematic_response", "tangent damped too", seen(split(lambda e: e, lambda e: -e)),
      "e is applied to the whole velocity. "
      "Restitution is about the normal component alone: without friction a body keeps its speed along the plane.",
      "A puck slides along the boards and touches them. What slows its sliding?"),
    M("kinematic_response", "tangent turned too", seen(split(lambda e: -1, lambda e: -e)),
      "The component along the plane is turned round as well: the body goes back the way it came.",
      "Draw a ball that hits the floor slanting. Which component changes?"),
    M("kinematic_response", "whole velocity turned", seen(split(lambda e: -e, lambda e: -e)),
      "The whole velocity is turned round and scaled by e: the body goes back the way it came.",
      "Draw a ball that hits the floor slanting. Which component changes?"),
    M("kinematic_response", "tangent lost", seen(split(lambda e: 0, lambda e: -e)),
      "Only the normal component comes back: the motion along the plane is lost.",
      "What becomes of the velocity along the plane?"),
    M("kinematic_response", "tangent mirrored", seen(split(lambda e: -1, lambda e: 1)),
      "2(v·N)N − v is the mirror image across the normal: right for a ray of light seen from its source, "
      "not for a ball.",
      "Which of the two components should change its sign?"),
    M("kinematic_response", "e squared", seen(split(lambda e: 1, lambda e: -e**2)),
      "e² scales the height of a bounce; the velocity is scaled by e.",
      "How does the height depend on the speed?"),
    M("kinematic_response", "root of e", seen(split(lambda e: 1, lambda e: -np.sqrt(e))),
      "The root of e would be right if e were a share of the energy. It is one of the speed.",
      "Of which quantity is e the fraction?"),
    M("kinematic_response", "loses the rest", seen(split(lambda e: 1, lambda e: -(1 - e))),
      "e is taken for the share that is lost. It is the share that is kept.",
      "What does e = 1 stand for?"),
    M("kinematic_response", "tangent scaled", seen(split(lambda e: e, lambda e: -1)),
      "e is applied to the component along the plane, and the normal one bounces perfectly: the two are mixed up.",
      "Which component does restitution speak of?"),
    M("kinematic_response", "along z only", seen(axis_only),
      "Only the z component is changed, whatever the normal: right for a floor, for no other plane.",
      "Which argument makes no difference to your answer?"),
    M("kinematic_response", "speed for velocity",
      seen(lambda v, n, e: np.where(dot(v, n) < 0, v + (1 + col(e)) * size(v) * n, v)),
      "The whole speed is used in place of the normal velocity v·N: right only for a body that comes straight on.",
      "How fast does a body come nearer that moves nearly along the plane?"),
    M("kinematic_response", "one for all", seen(all_at_once),
      "With several contacts in one call, one decision is made for all of them.",
      "One body approaches, another leaves. Does each get its own answer?"),
    M("kinematic_response", "no rebound", seen(lambda v, n, e: v - closing(v, n) * n + 0 * col(e)),
      "The body is stopped at the plane and no more: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("kinematic_response", "2 + e", seen(lambda v, n, e: v - (2 + col(e)) * closing(v, n) * n),
      "e was added to the slide's 2: even with e = 0 the bounce is perfect.",
      "Try e = 0. Where should the normal velocity be afterwards?"),
    M("kinematic_response", "change alone",
      lambda v, n, e, w=STILL: -(1 + col(e)) * closing(np.asarray(v) - w, n) * n,
      "It is the change of the velocity; the velocity from before is lost.",
      "What should come out of a body that moves away?"),
    M("kinematic_response", "divides by the speed",
      seen(lambda v, n, e: np.where(dot(v, n) < 0, v - (1 + col(e)) * dot(v, n) / size(v) * n, v)),
      "The velocity is made a unit vector before its normal part is taken: the change is too small for a fast body.",
      "What unit has the number that you multiply with the normal?"),
    M("kinematic_response", "unchanged",
      lambda v, n, e, w=STILL: 1.0 * np.asarray(v) + 0 * np.asarray(n) + 0 * col(e) + 0 * np.asarray(w),
      "The velocity comes back unchanged: nothing has been answered.",
      "What should be different afterwards?"),
    M("kinematic_response", "plane at rest", at_rest(respond),
      "The plane's velocity makes no difference: a racket that comes to meet the ball sends it back no faster.",
      "Which argument makes no difference to your answer?"),
    M("kinematic_response", "no guard, plane at rest", at_rest(unguarded),
      "The response is given whether or not the body approaches, and the plane's velocity makes no difference.",
      "What should become of a body that moves away? And which argument makes no difference to your answer?"),
    M("kinematic_response", "always perfect, plane at rest", at_rest(mirror),
      "Every bounce is perfect, as with the slide's 2, and off a plane at rest: neither the restitution "
      "nor the plane's velocity makes a difference.",
      "Which arguments make no difference to your answer?"),
    M("kinematic_response", "velocity in the plane's frame",
      lambda v, n, e, w=STILL: respond(np.asarray(v) - w, n, e),
      "It is the velocity as seen from the plane: the plane's own has to be added again.",
      "In whose frame was v given, and in whose is your answer?"),
    M("kinematic_response", "plane's velocity added",
      lambda v, n, e, w=STILL: v - (1 + col(e)) * closing(np.asarray(v) + w, n) * n,
      "The velocities are added. What counts is their difference: how fast the body comes nearer, seen from the plane.",
      "Body and plane move side by side at the same speed. Do they collide?"),
    M("kinematic_response", "guard of the body alone",
      lambda v, n, e, w=STILL: np.where(dot(v, n) < 0, unguarded_at(v, n, e, w), v + 0 * np.asarray(w)),
      "The guard looks at the body's own velocity; a plane may catch up with a body that moves away.",
      "Whose velocity says whether they come nearer?"),
    M("kinematic_response", "plane's velocity once", lambda v, n, e, w=STILL: respond(v, n, e) + dot(w, n) * n,
      "The plane's velocity is added to the bounce off a plane at rest. It should come in 1 + e times, "
      "through the relative velocity.",
      "Perfect bounce: a ball at rest is met by a racket at speed w. How fast is it afterwards, seen from the racket?"),
    M("kinematic_response", "dragged along", lambda v, n, e, w=STILL: respond(v, n, e) + w,
      "The whole velocity of the plane is added: without friction a plane that slides in itself drags nothing along.",
      "What does the plane's motion along itself do to the body?"),
    M("kinematic_response", "relative velocity turned",
      lambda v, n, e, w=STILL: v - (1 + col(e)) * closing(w - np.asarray(v), n) * n,
      "The relative velocity has the wrong order: with the normal out of the plane it is the body's less the plane's.",
      "Which sign has (v − w)·N of a body that comes nearer?"),
    M("kinematic_response", "plane stopped",
      lambda v, n, e, w=STILL: v - closing(np.asarray(v) - w, n) * n - col(e) * closing(v, n) * n,
      "The body's own velocity is scaled by e, not its velocity relative to the plane.",
      "What does e scale: a speed seen from the ground or from the plane?"),

    M("respond_at_impact", "rest of the step lost", stops_there,
      "It stops at the impact: the rest of the step is not integrated. "
      "That is where the slide stops, and every bounce loses on average half a step.",
      "What time is it when your function returns?"),
    M("respond_at_impact", "a whole step after the impact",
      lambda *given: struck(*given, rest=lambda T, dt: dt + 0 * T),
      "After the impact a whole step is made; only the rest of it is left.",
      "How long after the impact does the step end?"),
    M("respond_at_impact", "T again after the impact", lambda *given: struck(*given, rest=lambda T, dt: T + 0 * dt),
      "After the impact the time T is made once more; what is left is the rest of the step.",
      "How long after the impact does the step end?"),
    M("respond_at_impact", "not backed up", goes_on_unanswered,
      "The body goes on through the plane to the end of the step and gets its new velocity there: it is not backed up.",
      "Where is the body when it hits?"),
    M("respond_at_impact", "velocity of the start", old_velocity,
      "The velocity at the start of the step is answered; on its way to the plane the body has become faster.",
      "How fast is it when it hits?"),
    M("respond_at_impact", "always struck", always_struck,
      "A response is given even where the time of impact lies after the step.",
      "What does T = infinity say?"),
    M("respond_at_impact", "no guard of the response", lambda *given: struck(*given, answer=unguarded),
      "At the impact the velocity is turned whether or not the body approaches.",
      "What should become of a body that moves away?"),
    M("respond_at_impact", "always perfect", lambda *given: struck(*given, answer=mirror),
      "Every bounce is perfect: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("respond_at_impact", "no gravity after", lambda *given: struck(*given, glide=lambda a: 0 * a),
      "After the impact the acceleration is forgotten.",
      "Does gravity end at the bounce?"),
    M("respond_at_impact", "euler", euler_to_impact,
      "The places lack a t²/2: with constant acceleration the exact motion is known.",
      "How far does a body fall from rest in t seconds?"),
    M("respond_at_impact", "semi-implicit euler", semi_euler_to_impact,
      "The places come from the new velocity; with constant acceleration the exact motion is known.",
      "How far does a body fall from rest in t seconds?"),
    M("respond_at_impact", "last instant left out", lambda *given: struck(*given, last=np.less),
      "An impact at the very end of the step is not answered, and the next step may not see it either.",
      "Does the end belong to the step?"),
    M("respond_at_impact", "whole velocity turned",
      lambda *given: struck(*given, answer=split(lambda e: -e, lambda e: -e)),
      "At the impact the whole velocity is turned round; it should be its normal component.",
      "Which component does restitution speak of?"),
    M("respond_at_impact", "not answered", lambda *given: struck(*given, answer=lambda v, n, e: v + 0 * col(e)),
      "The body flies on through the plane: the velocity is not answered.",
      "What happens at the time of impact?"),
    M("respond_at_impact", "no rebound",
      lambda *given: struck(*given, answer=lambda v, n, e: respond(v, n, 0 * np.asarray(e))),
      "The body is stopped at the plane: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("respond_at_impact", "e for 1 + e",
      lambda *given: struck(*given, answer=lambda v, n, e: v - col(e) * closing(v, n) * n),
      "At the impact e stands in place of 1 + e: the body goes on into the plane.",
      "How much has to be taken away to stop it? And how much more to send it back?"),

    M("respond_at_step", "weight not carried", lambda *given: at_step(*given, carried=lambda a, n: 0 * a),
      "The weight pulls the body back in the very step in which it responds, as if there were no plane below it. "
      "Every rebound then starts g Δt too slow, and its apex is too low by (1 + e) v Δt/2 on average.",
      "The body lies on the plane in this step. Who carries its weight?"),
    M("respond_at_step", "no acceleration in the step", lambda *given: at_step(*given, carried=lambda a, n: a + 0 * n),
      "In the step of the response the whole acceleration is left out. The plane carries one component of it only.",
      "A ball bounces on a slope. Which part of its weight does the slope carry?"),
    M("respond_at_step", "holds what is pulled off",
      lambda *given: at_step(*given, carried=lambda a, n: dot(a, n) * n),
      "The component along the normal is taken from every acceleration, also from one that pulls the body off. "
      "A plane pushes, and never pulls.",
      "What does a ceiling do with the weight of a ball that bounces off it?"),
    M("respond_at_step", "weight always carried", always_carried,
      "The plane carries the weight of every body, also of one that is far in front of it.",
      "In which steps does the plane touch the body?"),
    M("respond_at_step", "weight carried behind", carried_behind,
      "The weight of a body that is on its way out is carried as well; only one that responds in this step is carried.",
      "A body behind the plane moves out. What changes its velocity?"),
    M("respond_at_step", "always answered",
      lambda *given: at_step(*given, when=lambda b, v, n: moves_in(0 * np.asarray(b) + 1, v, n)),
      "The velocity is answered wherever the body is, also far from the plane.",
      "When does a body collide?"),
    M("respond_at_step", "answered in front",
      lambda *given: at_step(*given, when=lambda b, v, n: moves_in(1 - np.asarray(b, dtype=float), v, n)),
      "The test is the wrong way round: bodies in front of the plane are answered.",
      "What does behind = True say?"),
    M("respond_at_step", "responds at the end", responds_at_the_end,
      "The body flies first and responds at the end of the step. "
      "That is another order of the loop: its apex is too low by (1 − e²) v Δt/2 on average.",
      "With which velocity does the body move in this step?"),
    M("respond_at_step", "steps, then responds", lambda *given: responds_at_the_end(*given, move=semi_euler),
      "The body takes its step first and responds at the end of it. "
      "That is another order of the loop: its apex is too low by (1 + e) v Δt/2 on average.",
      "With which velocity does the body move in this step?"),
    M("respond_at_step", "weight before the response", weight_first,
      "The velocity that is answered already has the weight of this step in it.",
      "Which velocity has the body at the start of the step?"),
    M("respond_at_step", "moved by the old velocity", moved_unanswered,
      "The velocity is answered, but the place still comes from the one before: the body goes on into the plane.",
      "Which velocity moves the body in this step?"),
    M("respond_at_step", "step lost", step_lost,
      "A body that responds stays where it is for the rest of the step. Its new velocity moves it at once.",
      "What time is it when your function returns?"),
    M("respond_at_step", "no guard", lambda *given: at_step(*given, answer=unguarded, when=within),
      "A body that is behind the plane but on its way out is thrown back in, step after step: it sticks.",
      "It is behind the plane and moves out. What then?"),
    M("respond_at_step", "always perfect", lambda *given: at_step(*given, answer=mirror),
      "Every bounce is perfect: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("respond_at_step", "euler", lambda *given: at_step(*given, move=euler),
      "The place comes from the velocity at the start of the step. "
      "Semi-implicit Euler changes the velocity first, and moves with the new one.",
      "Which velocity moves the body in a semi-implicit step?"),
    M("respond_at_step", "parabola", lambda *given: at_step(*given, move=flight),
      "The body moves on a parabola, with a Δt²/2. "
      "In a step of semi-implicit Euler it moves for the whole Δt with the velocity at its end.",
      "Which velocity moves the body in a semi-implicit step?"),
    M("respond_at_step", "velocity not integrated", lambda *given: at_step(*given, move=speed_unchanged),
      "The acceleration moves the body but does not make it faster.",
      "How fast is a body after falling for t seconds?"),
    M("respond_at_step", "not answered", lambda *given: at_step(*given, answer=lambda v, n, e: v + 0 * col(e)),
      "The body goes on through the plane: the velocity is not answered.",
      "What happens to a body that is behind the plane and moves in?"),
    M("respond_at_step", "no rebound",
      lambda *given: at_step(*given, answer=lambda v, n, e: respond(v, n, 0 * np.asarray(e))),
      "The body is stopped: the restitution makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("respond_at_step", "e for 1 + e",
      lambda *given: at_step(*given, answer=lambda v, n, e: v - col(e) * closing(v, n) * n),
      "e stands in place of 1 + e: the body goes on into the plane.",
      "How much has to be taken away to stop it? And how much more to send it back?"),
    M("respond_at_step", "whole velocity turned",
      lambda *given: at_step(*given, answer=split(lambda e: -e, lambda e: -e)),
      "The whole velocity is turned round; it should be its normal component.",
      "Which component does restitution speak of?"),
)
# fmt: on
