"""Known mistakes of what presses a body onto its support, and of a ball that slides until it rolls."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import along, col, direction, dot, flat, size

UP = np.array([0.0, 0.0, 1.0])


def support(m, g, f, a, n, load=None, press=None, rest=None):
    """Normal force and the rest, from all forces as the support sees them."""
    g, f, a, n = (np.asarray(each, dtype=float) for each in (g, f, a, n))
    every = (load or (lambda m, g, f, a: m * (g - a) + f))(col(m), g, f, a) + 0 * (col(m) * (g + a) + f)
    N = (press or (lambda F, n: np.maximum(0, -flat(dot(F, n)))))(every, n)
    return N, (rest or along)(every, n)


def loaded(load):
    return lambda *given: support(*given, load=load)


def pressed(press):
    return lambda *given: support(*given, press=press)


def remaining(rest):
    return lambda *given: support(*given, rest=rest)


def weight_for_normal_force(m, g, f, a, n):
    """The slide: N = m g."""
    _, rest = support(m, g, f, a, n)
    return np.asarray(m) * flat(size(g)) + 0 * flat(rest), rest


def the_other_way_round(m, g, f, a, n):
    N, rest = support(m, g, f, a, n)
    return N, -rest


def roll(v, w, R, mu, g, dt, arm=-1, slip=1, share=0.4, most=None, push=None, turn=1, stop=2 / 7, moved=1):
    """A step of a ball, with what may be wrong about it."""
    v, w = np.asarray(v, dtype=float), np.asarray(w, dtype=float)
    r, limit = -col(R) * UP, (most or (lambda mu, g, dt, R: mu * g * dt))(*map(np.asarray, (mu, g, dt, R)))
    u = v + slip * np.cross(w, arm * col(R) * UP)
    wanted = -stop * u
    length = size(wanted)
    J = wanted * np.where(length > col(limit), col(limit) / np.where(length > 0, length, 1), 1)
    J = J if push is None else push(J, wanted, u, col(limit))
    return v + moved * J + 0 * w, w + turn * np.cross(r, J) / (share * col(R) ** 2) + 0 * v


def with_(**parts):
    return lambda *given: roll(*given, **parts)


def against_the_velocity(v, w, R, mu, g, dt):
    """Friction opposes the velocity of the centre."""
    return roll(v, w, R, mu, g, dt, slip=0)


def block(v, w, R, mu, g, dt):
    """As if it did not turn."""
    return roll(v, w, R, mu, g, dt, slip=0, stop=1, turn=0)


def rolls_at_once(v, w, R, mu, g, dt):
    return roll(v, w, R, mu, g, dt, most=lambda mu, g, dt, R: 1e9 + 0 * mu * g * dt)


def without_radius(v, w, R, mu, g, dt):
    """ω + r × J/(2/5), with the square of the radius left out."""
    turned = roll(v, w, R, mu, g, dt)
    return turned[0], w + (turned[1] - w) * col(R) ** 2


# fmt: off
BANK = (
    M("support_force", "weight for the normal force", weight_for_normal_force,
      "The normal force is the weight m g, as slide 24 takes it to be. On an incline it is m g cos θ, "
      "and a push may lean on the body or lift it.",
      "Somebody leans on a crate. Does it press on the floor as it did before?"),
    M("support_force", "acceleration added", loaded(lambda m, g, f, a: m * (g + a) + f),
      "The support's acceleration is added to gravity. "
      "In a lift that starts upwards you feel heavier: a counts against g.",
      "A lift starts upwards. In which direction is its acceleration, and does the body press more or less?"),
    M("support_force", "support at rest", loaded(lambda m, g, f, a: m * g + f),
      "The support's own acceleration makes no difference: a box on a braking lorry would not slide.",
      "Which argument does your answer not depend on?"),
    M("support_force", "push left out", loaded(lambda m, g, f, a: m * (g - a)),
      "The push on the body makes no difference: somebody may lean on the body or lift it.",
      "Which argument does your answer not depend on?"),
    M("support_force", "no mass", loaded(lambda m, g, f, a: g - a + f),
      "Accelerations and a force are added: the accelerations have to be multiplied by the mass first.",
      "What units do the three terms have?"),
    M("support_force", "everything times the mass", loaded(lambda m, g, f, a: m * (g - a + f)),
      "The push is multiplied by the mass as well, although it is a force already.",
      "What units do the three terms have?"),
    M("support_force", "acceleration without the mass", loaded(lambda m, g, f, a: m * g - a + f),
      "The support's acceleration is subtracted as if it were a force: the mass is missing.",
      "What units do the three terms have?"),
    M("support_force", "push subtracted", loaded(lambda m, g, f, a: m * (g - a) - f),
      "The push has the wrong sign: it acts on the body as its weight does.",
      "Somebody leans on the body. Does it press more or less?"),
    M("support_force", "gravity turned round", loaded(lambda m, g, f, a: m * (-g - a) + f),
      "The given gravity is a vector that points down already; here it is turned round.",
      "In which direction does g point?"),
    M("support_force", "never lifts off", pressed(lambda F, n: -flat(dot(F, n))),
      "A force that lifts the body off gives a negative normal force: the support would hold on to the body.",
      "Can a floor pull?"),
    M("support_force", "lifting presses", pressed(lambda F, n: np.abs(flat(dot(F, n)))),
      "With the absolute value, a force that lifts the body off presses it on.",
      "What is left of the normal force when somebody lifts the body off?"),
    M("support_force", "sign of the normal force", pressed(lambda F, n: np.maximum(0, flat(dot(F, n)))),
      "The sign is wrong: a force into the support presses, and one out of it lifts.",
      "The normal points out of the support, and the weight into it. Which sign has F·n?"),
    M("support_force", "clamped the wrong way", pressed(lambda F, n: np.minimum(0, flat(dot(F, n)))),
      "It is the pressing part with its sign. The normal force is what the support pushes with, and not negative.",
      "How large should N be for a weight of 20 N on a level floor?"),
    M("support_force", "whole force", pressed(lambda F, n: flat(size(F)) + 0 * flat(size(n))),
      "The whole force is taken for the normal force: N is only its part along the normal, on an incline m g cos θ.",
      "How much of the weight presses on a steep slope?"),
    M("support_force", "vertical part", pressed(lambda F, n: np.maximum(0, -F[..., 2]) + 0 * flat(size(n))),
      "The vertical part of the force is taken, whatever the support's normal is.",
      "How much of its weight does a body press against a wall?"),
    M("support_force", "part along the normal", remaining(lambda F, n: dot(F, n) * n),
      "The second result is the part along the normal, which is the part to subtract.",
      "What should remain of a force straight into the surface?"),
    M("support_force", "normal part added", remaining(lambda F, n: F + dot(F, n) * n),
      "The normal part is added instead of subtracted.",
      "What should remain of a force straight into the surface?"),
    M("support_force", "mirrored", remaining(lambda F, n: F - 2 * dot(F, n) * n),
      "The normal part is subtracted twice: that mirrors the force at the surface.",
      "What should remain of a force straight into the surface?"),
    M("support_force", "z left out", remaining(lambda F, n: F * [1, 1, 0] + 0 * n),
      "The z component is left out, whatever the normal is: this is right on a level floor only.",
      "What lies along a slope? And along a wall?"),
    M("support_force", "each component alone", remaining(lambda F, n: F - F * n * n),
      "Component is multiplied by component, and nothing is added up: F·n is one number.",
      "What is (1, 2, 3)·(0, 0, 1)? And how many numbers is that?"),
    M("support_force", "pressing part alone", remaining(lambda F, n: F - np.minimum(dot(F, n), 0) * n),
      "The normal part is subtracted only where it presses.",
      "What is left along the surface of a force that points out of it?"),
    M("support_force", "whole force along the surface", remaining(lambda F, n: F + 0 * n),
      "The second result is the whole force. Friction has to hold only its part along the surface.",
      "What should remain of a force straight into the surface?"),
    M("support_force", "friction for the rest", the_other_way_round,
      "The second result is turned round: it is the friction that would hold the body, not what friction has to hold.",
      "On a slope, which way do the other forces pull the body?"),
    M("roll_step", "against the velocity", against_the_velocity,
      "Friction opposes the velocity of the centre. It opposes the slip of the point that touches the floor: "
      "backspin makes the slip larger, and a ball that rolls does not slip.",
      "A ball spins on the spot. Does friction act on it?"),
    M("roll_step", "sign of the arm", with_(arm=1),
      "The arm has the wrong sign, so that the slip is the velocity of the highest point of the ball.",
      "From the centre, where is the point that touches the floor?"),
    M("roll_step", "spin turned the wrong way", with_(turn=-1),
      "The impulse turns the ball the wrong way: friction would spin it up for ever.",
      "What is r × J for the arm r = −R z?"),
    M("roll_step", "arm and impulse swapped", with_(turn=-1, arm=1),
      "Both cross products have the wrong sign. Either their factors are exchanged (it is ω × r for the velocity, and"
      " r × J for the torque), or the arm points up in both of them, to the highest point of the ball.",
      "From the centre, where is the point that touches the floor? And which way does the ball begin to turn if"
      " friction pulls this point back?"),
    M("roll_step", "never rolls", with_(push=lambda J, wanted, u, limit: -limit * direction(u)),
      "Friction has its full size to the last: where it could stop the slip within the step, it turns the slip round.",
      "The ball almost rolls. How much friction does it need to stop its slip?"),
    M("roll_step", "rolls at once", rolls_at_once,
      "The slip stops in every step, however little friction there is.",
      "How large can friction be, for a ball of weight m g?"),
    M("roll_step", "a sliding block", block,
      "The ball is treated as a block that does not turn, and stops.",
      "Friction acts at the lowest point. What does it do to the spin?"),
    M("roll_step", "does not turn", with_(turn=0),
      "Friction changes the velocity and not the spin.",
      "Friction acts at the end of the arm r. What does it do to ω?"),
    M("roll_step", "does not slow", with_(moved=0),
      "Friction changes the spin and not the velocity.",
      "What does a force do to the centre of a body, wherever it acts?"),
    M("roll_step", "slip stopped as for a block", with_(stop=1),
      "The impulse that stops the slip is taken to be the whole slip. It also turns the ball, which takes away a part: "
      "an impulse J changes the slip by 7/2 J.",
      "By how much does an impulse J change v, and by how much ω × r?"),
    M("roll_step", "5/7 for 2/7", with_(stop=5 / 7),
      "The impulse is 5/7 of the slip. 5/7 of the speed is what remains to a ball that was thrown without spin; "
      "friction takes 2/7 away.",
      "A ball is thrown without spin. How fast does it roll in the end?"),
    M("roll_step", "a hollow ball", with_(share=2 / 3, stop=2 / 5),
      "The inertia is that of a hollow ball, 2/3 m R². A solid one has 2/5 m R².",
      "What is the inertia of a solid ball?"),
    M("roll_step", "inertia of a disc", with_(share=1 / 2, stop=1 / 3),
      "The inertia is that of a disc, m R²/2. A solid ball has 2/5 m R².",
      "What is the inertia of a solid ball?"),
    M("roll_step", "radius left out of the inertia", without_radius,
      "The square of the radius is missing in the inertia, 2/5 m R².",
      "What unit has r × J/(2/5)? And ω?"),
    M("roll_step", "friction without the step", with_(most=lambda mu, g, dt, R: mu * g + 0 * dt),
      "The force μ g is taken for the impulse: the length of the step is missing.",
      "What unit has μ g? And a velocity?"),
    M("roll_step", "gravity left out", with_(most=lambda mu, g, dt, R: mu * dt + 0 * g),
      "The normal force is missing: friction is at most μ times the weight.",
      "Which argument does your answer not depend on?"),
    M("roll_step", "friction drives the slip", with_(push=lambda J, wanted, u, limit: -J),
      "The sign is wrong: friction acts along the slip and makes it larger.",
      "The lowest point slides to the right. Which way does friction point?"),
    M("roll_step", "each component alone", with_(push=lambda J, wanted, u, limit: np.clip(wanted, -limit, limit)),
      "Each component of the friction is clamped by itself. "
      "Along the diagonal this is too much, and it points the wrong way.",
      "How large is the friction on a ball that slips along the diagonal?"),
)
# fmt: on
