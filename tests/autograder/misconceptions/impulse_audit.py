"""Known mistakes of the account of an impact: a body, a term or a mass forgotten, or a difference that is none."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, dot, flat, formulas_of, over

BODIES, ONE_BODY = formulas_of("impulse_bodies"), formulas_of("impulse_one_body")
turned, mass, inertia = BODIES.turned, BODIES.mass, BODIES.inertia


def carried(
    body, v, w, mass_of=mass, inertia_of=inertia, flight=lambda r, p: np.cross(p, r), spin=1, flies=1, turns=1, half=0.5
):
    """P, L about the contact, and the kinetic energy of one body that has these velocities."""
    _, _, r, share, k = body
    p, own = col(mass_of(share)) * v, turned(inertia_of(k), w)
    energy = half * (flies * flat(dot(p, v)) + turns * flat(dot(own, w)))
    return p + 0 * np.asarray(r), spin * own + flight(np.asarray(r), p), energy


def changed(body, v, w, **parts):
    return [new - old for new, old in zip(carried(body, v, w, **parts), carried(body, *body[:2], **parts), strict=True)]


def account(a, b, after, of=changed, on_a=1, on_b=1, **parts):
    """What both gain, or something else of each of the two, added up."""
    found = zip(of(a, *after[:2], **parts), of(b, *after[2:], **parts), strict=True)
    return tuple(on_a * x + on_b * y for x, y in found)


def account_with(**parts):
    return lambda a, b, after: account(a, b, after, **parts)


def added(body, v, w):
    return [new + old for new, old in zip(carried(body, v, w), carried(body, *body[:2]), strict=True)]


def afterwards(body, v, w):
    return [x + 0 * np.asarray(y) for x, y in zip(carried(body, v, w), carried(body, *body[:2]), strict=True)]


def of_the_changes(body, v, w):
    """The energy of a body that flies with Δv and spins with Δω."""
    return carried(body, np.asarray(v) - body[0], np.asarray(w) - body[1])


def with_energy(change):
    """The right momenta, and another energy."""

    def made(a, b, after):
        momentum, angular, energy = account(a, b, after)
        return momentum, angular, change(energy)

    return made


def per_number(k):
    """Each moment on the diagonal turned over, as if the body stood along the axes."""
    return over(1, np.diagonal(k, axis1=-2, axis2=-1), 0)[..., None] * np.eye(3)


def without_spin_of(of_a, of_b):
    """One body's spin left out."""

    def made(a, b, after):
        unturned = [ONE_BODY.unturnable(body) if left else body for body, left in ((a, of_a), (b, of_b))]
        return account(*unturned, after)

    return made


def without_spin_on_a_pivot(a, b, after):
    """What has 1/M = 0 left out, spin and all."""
    return account(*((*body[:4], col(col(np.asarray(body[3]) > 0)) * np.asarray(body[4])) for body in (a, b)), after)


def angular_of_velocities(a, b, after):
    """I Δω − r × Δv of both bodies."""
    angular = 0
    for body, (v, w) in ((a, after[:2]), (b, after[2:])):
        moves = body[3][..., None] > 0 if np.ndim(body[3]) else body[3] > 0
        flown = np.where(moves, np.asarray(v) - body[0], 0)
        angular = angular + turned(inertia(body[4]), np.asarray(w) - body[1]) - np.cross(body[2], flown)
    return angular


def with_mass_as_inertia(body):
    return *body[:4], np.asarray(body[3])[..., None, None] * np.eye(3) + 0 * np.asarray(body[4])


same = lambda k: np.asarray(k)  # noqa: E731
number = lambda s: np.asarray(s, dtype=float)  # noqa: E731
BEFORE_AND_AFTER = "Nothing happens: before and after are the same. What should the three numbers be?"
DEPENDS = "Which parts of the bodies does your answer not depend on?"
PASSING = "A ball flies past you in a straight line. Does it have angular momentum about you?"


# fmt: off
BANK = (
    M("audit", "inverse mass for the mass", account_with(mass_of=number),
      "1/M stands in place of M. The momentum on slide 13 is M v, and the bodies are given with 1/M.",
      "A marble and a cannon ball have the same velocity. Which one has more momentum?"),
    M("audit", "inverse inertia for the inertia", account_with(inertia_of=same),
      "I⁻¹ stands in place of I. The angular momentum of a spin is I ω, and the bodies are given with I⁻¹.",
      "A body that is hard to turn spins as fast as one that is easy to turn. Which one has more angular momentum?"),
    M("audit", "inverses throughout", account_with(mass_of=number, inertia_of=same),
      "1/M and I⁻¹ stand in place of M and I. The bodies are given with the inverses.",
      "A marble and a cannon ball have the same velocity. Which one has more momentum?"),
    M("audit", "no mass", account_with(mass_of=lambda s: 1 + 0 * np.asarray(s)),
      "The masses are left out, as if each body had 1 kg: it is the change of the velocities.",
      DEPENDS),
    M("audit", "no inertia", account_with(inertia_of=lambda k: np.eye(3) + 0 * np.asarray(k)),
      "The inertia is left out: the spin of slide 18 is not yet an angular momentum.",
      DEPENDS),
    M("audit", "spins alone", account_with(flight=lambda r, p: 0 * np.cross(r, p)),
      "The angular momentum has I ω of the two spins alone. "
      "A centre that flies past the point of contact has angular momentum about it as well.",
      PASSING),
    M("audit", "flight alone", account_with(spin=0),
      "The angular momentum has the flight of the two centres alone: I ω of the spins is missing.",
      "A wheel spins on the spot. Does it have angular momentum?"),
    M("audit", "r × P added", account_with(flight=np.cross),
      "r × M v is added. The arm r points from the centre to the contact; "
      "as seen from the contact, the centre is at −r.",
      "Where is the centre of a body, as seen from the point of contact?"),
    M("audit", "component by component", account_with(flight=lambda r, p: -r * p),
      "Arm and momentum are multiplied component by component; it is a cross product.",
      "About which axis does a ball that flies along y pass a point beside it on x?"),
    M("audit", "no mass in the flight",
      lambda a, b, after: (account(a, b, after)[0], angular_of_velocities(a, b, after), account(a, b, after)[2]),
      "The angular momentum has r × v: the mass is missing there.",
      "What unit has each of the terms of the angular momentum?"),
    M("audit", "mass for the inertia",
      lambda a, b, after: account(*(with_mass_as_inertia(body) for body in (a, b)), after),
      "The spin is multiplied with the mass in place of the inertia.",
      "What unit has M ω, and what unit an angular momentum?"),
    M("audit", "diagonal of the inverse inertia", account_with(inertia_of=per_number),
      "Each number on the diagonal of I⁻¹ is turned over: right only for a body that stands along the axes. "
      "The inverse of a matrix is another one.",
      "What is I⁻¹ times your I?"),
    M("audit", "A alone", account_with(on_b=0),
      "B does not count: it is the account of one body.",
      "What does Newton's third law say of the two bodies?"),
    M("audit", "B alone", account_with(on_a=0),
      "A does not count: it is the account of one body.",
      "What does Newton's third law say of the two bodies?"),
    M("audit", "A less B", account_with(on_b=-1),
      "B's change is taken away from A's. The momentum of two bodies together is the sum.",
      "Two equal balls swap their velocities. How much momentum do they gain together?"),
    M("audit", "before less after", account_with(on_a=-1, on_b=-1),
      "Before and after are exchanged: it is what the bodies lose, not what they gain.",
      "Which sign should the energy have if the impact takes some?"),
    M("audit", "sum of before and after", account_with(of=added),
      "The numbers before and after are added. A change is what comes afterwards less what was before.",
      BEFORE_AND_AFTER),
    M("audit", "after alone", account_with(of=afterwards),
      "It is what the bodies have after the impact: what they had before is not taken away.",
      BEFORE_AND_AFTER),
    M("audit", "sizes", lambda a, b, after: tuple(map(np.abs, account(a, b, after))),
      "The signs are lost: nobody can tell a gain from a loss any more.",
      "Which sign should the energy have if the impact takes some?"),
    M("audit", "energy without spin", account_with(turns=0),
      "The energy has the flight of the bodies alone: the energy of their spins is missing.",
      "A wheel spins on the spot. Does it have energy?"),
    M("audit", "energy of the spins alone", account_with(flies=0),
      "The energy has the spins of the bodies alone: the energy of their flight is missing.",
      "A ball flies without spin. Does it have energy?"),
    M("audit", "energy without the half", account_with(half=1),
      "The energy lacks the factor of a half.",
      "How much work does it take to bring 1 kg to 2 m/s?"),
    M("audit", "energy lost", with_energy(np.negative),
      "The energy has the other sign: it is what the impact takes, not what the bodies gain.",
      "What does the description say of an impact that takes energy?"),
    M("audit", "energy of the changes",
      lambda a, b, after: (*account(a, b, after)[:2], account(a, b, after, of=of_the_changes)[2]),
      "The energy is that of a body with the velocities Δv and Δω. The square of a difference is not the difference of "
      "the squares.",
      "A ball of 1 kg bounces back with the speed that it had. By how much does its energy change?"),
    M("audit", "A's arm for both", ONE_BODY.arm_of_a(account), ONE_BODY.ONE_ARM.format("A"), ONE_BODY.EACH_CENTRE),
    M("audit", "B's arm for both", ONE_BODY.arm_of_b(account), ONE_BODY.ONE_ARM.format("B"), ONE_BODY.EACH_CENTRE),
    M("audit", "only A turns", without_spin_of(False, True),
      "B's spin does not count, neither in the angular momentum nor in the energy.", ONE_BODY.SWAP),
    M("audit", "only B turns", without_spin_of(True, False),
      "A's spin does not count, neither in the angular momentum nor in the energy.", ONE_BODY.SWAP),
    M("audit", "A's arm left out", ONE_BODY.arm_left_out(account, of_a=True),
      "A's arm is used nowhere, as if A's centre flew straight through the point of contact.", PASSING),
    M("audit", "B's arm left out", ONE_BODY.arm_left_out(account, of_b=True),
      "B's arm is used nowhere, as if B's centre flew straight through the point of contact.", PASSING),
    M("audit", "spin on a pivot left out", without_spin_on_a_pivot,
      "A body whose centre cannot move is left out, spin and all. It may still turn about its centre.",
      "A door hits a chair. Its hinges stay where they are; does it have energy before, and after?"),
    M("audit", "infinite mass", account_with(mass_of=lambda s: over(1, s, np.inf)),
      "The mass of an immovable body is infinite here, and inf · 0 is no number. Such a body counts nothing.",
      "What does the description say of a body with 1/M = 0?"),
)
# fmt: on
