"""Known mistakes in making a penalty contact to measure."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M


def swept(zeta):
    """The angle 2 arccos(ζ)/√(1 − ζ²) of a contact, also above ζ = 1."""
    across = np.sqrt(np.abs(1 - zeta**2))
    angle = np.where(zeta < 1, np.arccos(np.minimum(zeta, 1)), np.arccosh(np.maximum(zeta, 1)))
    return 2 * np.where(across > 0, angle / np.where(across > 0, across, 1), 1)


def ratio(e):
    """The damping ratio that leaves e, by halving an interval."""
    low, high = np.zeros(np.shape(e)), 1 / np.sqrt(e)
    for _ in range(60):
        middle = (low + high) / 2
        lively = np.exp(-middle * swept(middle)) > e
        low, high = np.where(lively, middle, low), np.where(lively, high, middle)
    return np.where(np.asarray(e) < 1, middle, 0.0)


def energy(m, v, d, e):
    return m * v**2 / d**2


def proper(e):
    return 2 * ratio(e)


def half_period(m, k, c):
    return np.pi * np.sqrt(m / k)


def designed(stiffness=energy, damping=proper, lasts=half_period, step=lambda t, n: t / n):
    """A design by other rules. damping: c/√(k m) of e. lasts: how long a contact is said to last."""

    def contact(m, v, d, e, n):
        m, v, d, e, n = (np.asarray(each, dtype=float) for each in (m, v, d, e, n))
        k = stiffness(m, v, d, e)
        c = damping(e) * np.sqrt(k * m)
        return k, c, step(lasts(m, k, c), n)

    return contact


def adhesive(e):
    loss = -np.log(e)
    return 2 * loss / np.hypot(np.pi, loss)


def damping_of_the_mass(m, v, d, e, n):
    k, _, dt = designed()(m, v, d, e, n)
    return k, proper(e) * np.asarray(m), dt


def timestep_second(*given):
    k, c, dt = designed()(*given)
    return k, dt, c


def limit(m, k, c):
    omega, zeta = np.sqrt(k / m), c / (2 * np.sqrt(k * m))
    return 2 / (omega * (np.sqrt(1 + zeta**2) + zeta))


def damped_contact(m, k, c):
    zeta = c / (2 * np.sqrt(k * m))
    return swept(zeta) * np.sqrt(m / k)


# fmt: off
BANK = (
    M("design_contact", "energy of the spring without its half", designed(lambda m, v, d, e: m * v**2 / (2 * d**2)),
      "The energy of the spring is taken as k d². It is k d²/2, because the force grows from 0 to k d on the way in: "
      "your spring is half as stiff, and the body goes √2 times too deep.",
      "How much work does it take to press a spring in by d?"),
    M("design_contact", "energy of the motion without its half", designed(lambda m, v, d, e: 2 * m * v**2 / d**2),
      "The energy of the motion is taken as m v². It is m v²/2: your spring is twice as stiff as it has to be.",
      "How much energy has a body of 2 kg at 3 m/s?"),
    M("design_contact", "depth of rest", designed(lambda m, v, d, e: 9.81 * m / d + 0 * v),
      "It is the spring on which the body lies at rest at that depth, k = m g/d. An impact goes deeper, and the "
      "faster the body comes, the deeper.",
      "Which argument makes no difference to your stiffness?"),
    M("design_contact", "momentum for energy", designed(lambda m, v, d, e: m * v / d),
      "The speed comes in only once, as in a momentum. Twice the speed is four times the energy.",
      "What is the unit of your stiffness?"),
    M("design_contact", "depth not squared", designed(lambda m, v, d, e: m * v**2 / d),
      "m v²/d is a force. A spring's stiffness is a force over a depth.",
      "What is the unit of your stiffness?"),
    M("design_contact", "mass left out", designed(lambda m, v, d, e: (v / d) ** 2 + 0 * m),
      "v²/d² is ω², the stiffness for each kilogram: the mass is left out.",
      "Does a heavy body need the same spring as a light one?"),
    M("design_contact", "frequency for stiffness", designed(lambda m, v, d, e: v / d + 0 * m),
      "v/d is ω, the frequency of the swing. The stiffness is m ω².",
      "What is the unit of your stiffness?"),
    M("design_contact", "depth upside down", designed(lambda m, v, d, e: m * v**2 * d**2),
      "The depth is above the line: the spring would be softer where less depth is permitted.",
      "Permit half the depth. Should the spring be stiffer or softer?"),
    M("design_contact", "energy that is left", designed(lambda m, v, d, e: e**2 * m * v**2 / d**2),
      "The energy that the body has after the impact is put into the spring. On its way in it still has all of it.",
      "How fast is the body at the first touch?"),
    M("design_contact", "just deep enough with the damper", designed(lambda m, v, d, e: e * m * v**2 / d**2),
      "With this spring and its damper the body turns round exactly at the permitted depth, which is well derived. "
      "But the rule of this function is another: the spring alone, without the damper, turns it round there.",
      "Read the first of the three rules again. What does the damper do in it?"),
    M("design_contact", "no damping", designed(damping=lambda e: 0 * e),
      "There is no damping: every bounce is perfect, whatever restitution is asked for.",
      "Which argument makes no difference to your answer?"),
    M("design_contact", "damping that pulls", designed(damping=adhesive),
      "It is the damping of a contact that may pull, ζ = −ln e/√(π² + ln² e). With the clamp the contact ends earlier, "
      "and the body leaves with more speed than you asked for.",
      "What does penalty_damping return where `adhesive` is left out?"),
    M("design_contact", "critical damping", designed(damping=lambda e: 2 + 0 * e),
      "The damping is critical, whatever restitution is asked for.",
      "Which argument makes no difference to your damping?"),
    M("design_contact", "1 − e for the ratio", designed(damping=lambda e: 2 * (1 - e)),
      "1 − e is taken for the damping ratio. It has the right end at e = 1, and no others.",
      "Which given function returns the damping for a restitution?"),
    M("design_contact", "damping with the mass for k m", damping_of_the_mass,
      "The damping is 2 ζ m; it should be 2 ζ √(k m).",
      "What is the unit of your damping?"),
    M("design_contact", "whole period", designed(lasts=lambda m, k, c: 2 * np.pi * np.sqrt(m / k)),
      "A contact is taken for a whole period of the swing. The body leaves after half of one: "
      "the other half would be in the air.",
      "A swing passes the middle, the far end, the middle again. How much of a period is that?"),
    M("design_contact", "quarter of a period", designed(lasts=lambda m, k, c: np.pi / 2 * np.sqrt(m / k)),
      "A contact is taken for a quarter of a period. That is the way in alone; the way out takes as long.",
      "Where is the body after a quarter of a period?"),
    M("design_contact", "1/ω", designed(lasts=lambda m, k, c: np.sqrt(m / k)),
      "The contact is said to last 1/ω, which is neither a period nor half of one: π is missing.",
      "How long is a period, if ω = √(k/m)?"),
    M("design_contact", "depth over speed, there and back", designed(lasts=lambda m, k, c: 2 * np.sqrt(m / k)),
      "The contact is said to last 2 d/v, as if the body kept its speed on the way in and on the way out. "
      "It slows down, and takes π d/v.",
      "How fast is the body at the permitted depth?"),
    M("design_contact", "step limit for the contact", designed(lasts=limit),
      "It is the longest stable step that is divided, not the time of the contact.",
      "What is to be divided into so many steps?"),
    M("design_contact", "contact with the damper", designed(lasts=damped_contact),
      "It is the time of the contact with its damper. "
      "The rule of this function divides that of the spring alone, π/ω.",
      "Read the third of the three rules again. What does the damper do in it?"),
    M("design_contact", "frequency upside down", designed(lasts=lambda m, k, c: np.pi * np.sqrt(k / m)),
      "π ω is no time: ω belongs below the line.",
      "What is the unit of your timestep?"),
    M("design_contact", "root left out", designed(lasts=lambda m, k, c: np.pi * m / k),
      "k/m is ω², not ω: the root is missing.",
      "What is the unit of your timestep?"),
    M("design_contact", "not divided", designed(step=lambda t, n: t + 0 * n),
      "The timestep is the whole contact: the number of steps makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("design_contact", "times the steps", designed(step=lambda t, n: t * n),
      "The time of the contact is multiplied with the number of steps: more steps should be shorter ones.",
      "Ask for twice as many steps. Should a step become longer or shorter?"),
    M("design_contact", "timestep second", timestep_second,
      "The timestep is returned second and the damping third.",
      "In which order does the description name what is returned?"),
)
# fmt: on
