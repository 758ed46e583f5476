"""Laws of an impact with friction: each against its own meaning of e, small steps by scipy, and the closed forms."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from reference import impact_truth
from solutions.friction import (
    dissipative_impulse,
    friction_impulse,
    impact_energy,
    point_inverse_mass,
    poisson_impulse,
    stronge_impulse,
)

UP = np.array([0.0, 0.0, 1.0])
LAWS = {"dissipative": dissipative_impulse, "poisson": poisson_impulse, "stronge": stronge_impulse}
FOLLOWED = {"poisson": poisson_impulse, "stronge": stronge_impulse}
MU = [0.0, 0.05, 0.2, 0.5, 1.0, 2.0]


def coupled(count, seed=0):
    """Oblique impacts of two unequal bodies at points anywhere: u, n, K, e and μ of each."""
    rng = np.random.default_rng(seed)

    def body():
        turn = np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]
        radii = rng.uniform(0.1, 0.5, size=(count, 3)) ** 2
        moments = radii.sum(axis=1, keepdims=True) - radii
        inverse_inertia = (turn / moments[:, None, :]) @ np.swapaxes(turn, -1, -2)
        return rng.uniform(0.2, 3, count), inverse_inertia, rng.normal(size=(count, 3)) * 0.3

    k = point_inverse_mass(*body()) + point_inverse_mass(*body())
    n = rng.normal(size=(count, 3))
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    u = rng.normal(size=(count, 3))
    u = np.where((np.vecdot(u, n) > 0)[:, None], -u, u)
    return u, n, k, rng.uniform(size=count), rng.uniform(0, 1.5, count)


def stiff(count, seed=0):
    """Impacts with matrices of condition up to 100 and any friction, in which a slip turns fast and settles."""
    rng = np.random.default_rng(seed)
    u, n, _, e, _ = coupled(count, seed)
    axes = np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]
    k = (axes * 100 ** rng.uniform(size=(count, 1, 3))) @ np.swapaxes(axes, -1, -2)
    return u, n, k, e, 10 ** rng.uniform(-1, 1, count)


def contact_energy(u, k):
    """Energy that an impact can take at most, J: that of stopping both points dead."""
    return np.vecdot(u, np.linalg.solve(k, u[..., None])[..., 0]) / 2


def check_cone(impulse, normal, friction):
    pressed = np.vecdot(impulse, normal)
    across = np.linalg.norm(impulse - pressed[:, None] * normal, axis=-1)
    assert np.all(pressed > 0)
    assert np.all(across <= friction * pressed * (1 + 1e-9))  # a matrix of condition up to some thousand


def check_energy(laws, u, n, k, e, mu):
    """No law adds energy, and every impulse lies in the cone."""
    most = contact_energy(u, k)
    for law in laws:
        impulse = law(u, n, k, e, mu)
        check_cone(impulse, n, mu)
        assert np.all(impact_energy(u, impulse, k) <= 1e-9 * most)


@pytest.mark.statement(16, oracle="the energy of twenty thousand impacts of odd bodies")
@pytest.mark.slow
def test_maximal_dissipation_never_gains_over_no_friction():
    u, n, k, e, mu = coupled(20_000)
    check_energy([dissipative_impulse], u, n, k, e, mu)
    smooth, impulse = friction_impulse(u, n, k, e, 0.0), dissipative_impulse(u, n, k, e, mu)
    assert np.all(impact_energy(u, impulse, k) <= impact_energy(u, smooth, k) + 1e-9 * contact_energy(u, k))
    assert np.vecdot(u + np.matvec(k, impulse), n) == pytest.approx(-e * np.vecdot(u, n), abs=1e-11)


@pytest.mark.statement(16, oracle="the energy of impacts of odd bodies")
def test_no_law_adds_energy_where_newtons_adds_most():
    cases = coupled(20_000)
    u, n, k, e, mu = cases
    gained = impact_energy(u, friction_impulse(u, n, k, e, mu), k) / contact_energy(u, k)
    worst = np.argsort(gained)[-30:]
    assert (gained[worst] > 0).sum() >= 15
    assert gained.max() > 0.3
    worst = np.append(worst, [5058, 7194])  # in these two the slip shrinks to the error of a step and must stop there
    check_energy(FOLLOWED.values(), *(value[worst] for value in cases))


@pytest.mark.slow
def test_no_law_adds_energy_in_twenty_thousand_impacts():
    check_energy(FOLLOWED.values(), *coupled(20_000))


def test_maximal_dissipation_leaves_less_energy_than_any_other_friction():
    u, n, k, e, mu = coupled(60, seed=1)
    least = impact_energy(u, dissipative_impulse(u, n, k, e, mu), k)
    best = np.full(60, np.inf)
    first = np.cross(n, [0.3, 0.5, 0.7])
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(n, first)
    stiff = np.vecdot(n, np.matvec(k, n))
    for angle in np.linspace(0, 2 * np.pi, 181)[:-1]:
        for share in np.linspace(0, 1, 41):  # of the cone
            push = n + (share * mu)[:, None] * (np.cos(angle) * first + np.sin(angle) * second)
            gain = np.vecdot(n, np.matvec(k, push))
            size = np.where(gain > 1e-9 * stiff, -(1 + e) * np.vecdot(u, n) / np.where(gain > 0, gain, 1.0), 0.0)
            energy = impact_energy(u, size[:, None] * push, k)
            best = np.where((size > 0) & (energy < best), energy, best)
    most = contact_energy(u, k)
    assert np.all(least <= best + 1e-12 * most)
    assert np.median((best - least) / most) < 1e-3  # the search is that coarse, and finds nothing else
    assert np.all(best - least < 0.02 * most)


# Poisson and Stronge against the equations themselves


class SmallSteps:
    """The equations of an impact for scipy: impulse and work over the normal impulse, friction against each slip.

    The slip divides by its size, with a millionth of the speed beside it, so that a slip that stops needs no case. Near
    there friction turns with the slip at once, and the equations are stiff. With `slopes` a solver needs some hundred
    evaluations; by its own differences, in which a slip so short is lost, it took a million.
    """

    accurate: ClassVar = {"method": "LSODA", "rtol": 1e-9, "atol": 1e-12}

    def __init__(self, u, n, k, mu):
        self.u, self.n, self.k, self.mu = u, n, k, mu
        self.soft = 1e-6 * np.linalg.norm(u)

    def growth(self, _, state):
        now, along, _ = self._slip(state)
        return np.append(self.n - self.mu * along, now @ self.n)

    def slopes(self, _, state):
        _, along, size = self._slip(state)
        flat = np.eye(3) - np.outer(self.n, self.n)
        turning = (np.eye(3) - np.outer(along, along)) @ flat @ self.k
        return np.block([[-self.mu / size * turning, np.zeros((3, 1))], [self.n @ self.k, 0.0]])

    def _slip(self, state):
        now = self.u + self.k @ state[:3]
        slip = now - (now @ self.n) * self.n
        size = np.hypot(np.linalg.norm(slip), self.soft)
        return now, slip / size, size

    def solve(self, begin, end, state, **options):
        return solve_ivp(self.growth, (begin, end), state, jac=self.slopes, **self.accurate, **options)


def small_steps(u, n, k, mu, law, e):
    """An impact by scipy, until it ends by the law's own meaning of e."""
    steps = SmallSteps(u, n, k, mu)

    def approach(_, state):
        return (u + k @ state[:3]) @ n

    approach.terminal, approach.direction = True, 1
    closing = steps.solve(0, 1e3 * -(u @ n) / (n @ k @ n), np.zeros(4), events=approach)
    pressed, at_turn = closing.t_events[0][0], closing.y_events[0][0]
    if law == "poisson":
        return steps.solve(pressed, (1 + e) * pressed, at_turn).y[:3, -1]

    def worked(_, state):
        return state[3] - (1 - e**2) * at_turn[3]

    worked.terminal, worked.direction = True, 1
    return steps.solve(pressed, 1e3 * pressed, at_turn, events=worked).y_events[0][0][:3]


@pytest.mark.statement(16, oracle="scipy's integration of the impact over the normal impulse")
@pytest.mark.parametrize("setups", [coupled, stiff])
@pytest.mark.parametrize("law", FOLLOWED)
def test_an_impact_in_space_is_the_one_that_scipy_integrates(law, setups):
    u, n, k, e, mu = setups(12, seed=2)
    ours = FOLLOWED[law](u, n, k, e, mu)
    for i in range(12):
        expected = small_steps(u[i], n[i], k[i], mu[i], law, e[i])
        # a millionth of the speed beside the slip
        assert ours[i] == pytest.approx(expected, abs=2e-5 * np.linalg.norm(expected))


@pytest.mark.parametrize("law", FOLLOWED)
def test_a_slip_that_settles_just_before_it_stops_is_followed(law):
    u = np.array([0.1350432, 0.03200186, -0.71470324])
    along, across, up = 61.75248476, 5.76065585, 9.11837386
    a, b, c = -13.95128008, 14.47499758, -2.99333409
    k = np.array([[along, a, b], [a, across, c], [b, c, up]])
    expected = small_steps(u, UP, k, 0.6337905, law, 0.9953)
    # The slip that scipy is allowed is a millionth of the speed
    assert FOLLOWED[law](u, UP, k, 0.9953, 0.6337905) == pytest.approx(expected, abs=2e-5 * np.linalg.norm(expected))


# What each means by e


@pytest.mark.statement(16, oracle="Poisson's ratio of the normal impulses")
def test_poissons_e_is_the_ratio_of_the_two_normal_impulses():
    u, n, k, e, mu = coupled(50, seed=3)
    closing = poisson_impulse(u, n, k, 0.0, mu)
    assert np.vecdot(u + np.matvec(k, closing), n) == pytest.approx(np.zeros(50), abs=1e-8)  # the approach has ended
    whole = np.vecdot(poisson_impulse(u, n, k, e, mu), n)
    assert whole == pytest.approx((1 + e) * np.vecdot(closing, n), rel=1e-9)


@pytest.mark.statement(16, oracle="scipy's integration of the work over the normal impulse")
def test_stronges_e_squared_is_the_ratio_of_the_two_works():
    for u, n, k, e, mu in zip(*coupled(6, seed=8), strict=True):
        ends = [stronge_impulse(u, n, k, each, mu) @ n for each in (0.0, e)]
        work = SmallSteps(u, n, k, mu).solve(0, ends[1], np.zeros(4), t_eval=ends).y[3]
        # A millionth of the speed beside the slip, and e = 0 ends where the work has its turning point
        assert (work[1] - work[0]) / -work[0] == pytest.approx(e**2, abs=1e-5)


@pytest.mark.parametrize("law", FOLLOWED)
@pytest.mark.slow
def test_the_points_part_even_where_friction_makes_them_approach_again(law):
    k = np.array([[26.0, 3, -17], [3, 29, 4], [-17, 4, 14]])
    u = np.array([2.0, 5, -1])
    for e in (0.0, 0.5, 1.0):
        assert (u + k @ FOLLOWED[law](u, UP, k, e, 1.5))[2] >= (e > 0) * 0.1 - 1e-12
    rng = np.random.default_rng(9)
    rows = rng.integers(-4, 5, (500, 3, 3))
    k = rows @ np.swapaxes(rows, 1, 2) + rng.uniform(0.1, 3, (500, 1, 1)) * np.eye(3)
    u = rng.normal(size=(500, 3)) - 3 * UP
    after = u + np.matvec(k, FOLLOWED[law](u, UP, k, rng.uniform(size=500), rng.uniform(0, 3, 500)))
    assert np.all(after[u[:, 2] < 0, 2] > -1e-8)


def in_the_plane(arm_x, arm_z, inertia, slip, speed, friction):
    """A body of 1 kg that moves in the x–z plane alone: K, u, and the contact as the closed form has it."""
    k = point_inverse_mass(1.0, np.diag([0, 1 / inertia, 0]), (arm_x, 0.0, arm_z)) + np.diag([0, 1.0, 0])
    contact = impact_truth.Contact(k[0, 0], k[0, 2], k[2, 2], slip, -speed, friction)
    return k, np.array([slip, 0.0, -speed]), contact


@pytest.mark.statement(16, oracle="the legs of an impact in the plane, in closed form")
@pytest.mark.parametrize("law", LAWS)
def test_in_the_plane_each_law_is_its_closed_form(law):
    rng = np.random.default_rng(7)
    setups = [
        in_the_plane(*rng.uniform(-1, 1, 2), rng.uniform(0.02, 1), rng.normal(), rng.uniform(0.1, 3), rng.choice(MU))
        for _ in range(300)
    ]
    e, mu = rng.choice([0.0, 0.3, 0.7, 1.0], 300), np.array([contact.friction for _, _, contact in setups])
    expected = [
        impact_truth.planar_impact(setup[2], *case, law) for setup, case in zip(setups, e[:, None], strict=True)
    ]
    along, pressed = np.array(expected).T
    found = LAWS[law](np.array([u for _, u, _ in setups]), UP, np.array([k for k, _, _ in setups]), e, mu)
    near = 1e-9 * (1 + pressed)  # a matrix of condition up to some thousand, and the root of a difference of works
    assert np.all(np.abs(found - np.stack([along, np.zeros(300), pressed], axis=-1)) <= near[:, None])


def test_a_slip_that_stops_begins_again_where_friction_cannot_hold_it():
    # The normal impulse alone pulls the end of this rod along by 1.44 for each unit: with μ = 0.3 it cannot be held
    k, u, _ = in_the_plane(-0.4, -0.3, 1 / 12, 0.3, 1.0, 0.3)
    for law in FOLLOWED.values():
        impulse = law(u, UP, k, 0.5, 0.3)
        assert (u + k @ impulse)[0] < -0.1  # turned round
        assert abs(impulse[0]) < 0.29 * impulse[2]  # friction first one way and then the other
    # Turned by 40° about the normal it is the same impact
    c, s = np.cos(0.7), np.sin(0.7)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
    for law in FOLLOWED.values():
        turned = law(turn @ u, UP, turn @ k @ turn.T, 0.5, 0.3)
        assert turned == pytest.approx(turn @ law(u, UP, k, 0.5, 0.3), abs=1e-9)


# Where they are one law


@pytest.mark.statement(16, oracle="Newton's law, where slip neither couples nor changes")
@pytest.mark.parametrize("law", LAWS)
def test_all_laws_agree_for_spheres_and_without_friction(law):
    u, n, k, e, mu = coupled(200, seed=5)
    e[:20], mu[20:40] = 1.0, 0.0
    ball = point_inverse_mass(1.3, np.eye(3) / 0.1, -0.4 * n)
    assert LAWS[law](u, n, ball, e, mu) == pytest.approx(friction_impulse(u, n, ball, e, mu), abs=1e-10)
    smooth = friction_impulse(u, n, k, e, 0.0)
    assert LAWS[law](u, n, k, e, 0.0) == pytest.approx(smooth, abs=1e-10)


def test_newton_poisson_and_stronge_agree_where_the_slip_goes_on():
    # A slip of 9 m/s at μ = 0.1 that outlasts the impact, in both directions, of a rod struck at its end
    for slip in (9.0, -9.0):
        k, u, _ = in_the_plane(-0.4, -0.3, 1 / 12, slip, 1.0, 0.1)
        expected = friction_impulse(u, UP, k, 0.6, 0.1)
        for law in FOLLOWED.values():
            assert law(u, UP, k, 0.6, 0.1) == pytest.approx(expected, abs=1e-14)
    # A slip that turns round parts them
    k, u, _ = in_the_plane(-0.4, -0.3, 1 / 12, 0.5, 1.0, 0.1)
    parting = [(u + k @ law(u, UP, k, 0.6, 0.1))[2] for law in (friction_impulse, poisson_impulse, stronge_impulse)]
    assert parting[0] == pytest.approx(0.6, abs=1e-14)
    assert min(abs(parting[0] - parting[1]), abs(parting[1] - parting[2]), abs(parting[2] - parting[0])) > 0.005


# One is many; what is refused


@pytest.mark.parametrize("law", LAWS)
def test_many_impacts_are_the_same_as_one_after_another(law):
    u, n, k, e, mu = coupled(4, seed=6)
    kept = [value.copy() for value in (u, n, k, e, mu)]
    u[0] = -u[0]  # parts
    together = LAWS[law](u, n, k, e, mu)
    alone = np.array([LAWS[law](*case) for case in zip(u, n, k, e, mu, strict=True)])
    assert together == pytest.approx(alone, abs=1e-10)
    assert together[0].tolist() == [0, 0, 0]
    assert np.array_equal(k, kept[2])
    assert LAWS[law](u[:, None], n[:, None], k[:, None], e, 0.3).shape == (4, 4, 3)
    # Powers of two round nothing
    exact = LAWS[law](u[1] * 2.0**30, n[1], k[1] * 2.0**-40, e[1], mu[1])
    assert exact == pytest.approx(together[1] * 2.0**70, rel=1e-8)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("velocity", {"velocity": np.nan * UP}),
        ("normal", {"normal": 2 * UP}),
        ("inverse_mass", {"inverse_mass": np.zeros((3, 3))}),
        ("inverse_mass", {"inverse_mass": [[1, 2, 2], [2, 1, 2], [2, 2, 1]]}),  # its determinant is 5
        ("restitution", {"restitution": 1.1}),
        ("friction", {"friction": -0.1}),
    ],
)
def test_a_law_refuses_what_is_no_impact_by_name(law, name, wrong):
    whole = {"velocity": -UP, "normal": UP, "inverse_mass": np.eye(3), "restitution": 0.5, "friction": 0.5}
    with pytest.raises(ValueError, match=f"^{name}"):
        LAWS[law](**(whole | wrong))


def test_the_page_of_responses_says_what_each_law_does_to_a_rod():
    k, u, _ = in_the_plane(-0.4, -0.3, 1 / 12, 0.5, 1.0, 0.75)
    said = {
        friction_impulse: (1.0, 0.0, 0.08875),
        dissipative_impulse: (1.0, -0.4932, -2e-5),
        poisson_impulse: (0.6538, 0.0, -0.0601),
        stronge_impulse: (0.7338, 0.0, -0.03125),
    }
    for law, (parting, slip, gained) in said.items():
        impulse = law(u, UP, k, 1.0, 0.75)
        after = u + k @ impulse
        assert after == pytest.approx([slip, 0.0, parting], abs=5e-5)
        assert impact_energy(u, impulse, k) == pytest.approx(gained, abs=1e-5)
    u = u * [-1, 1, 1]  # the end slides the other way
    for law, (slip, gained) in zip(
        said, [(-0.3696, -0.3544), (-0.4932, -0.36)] + [(-0.3696, -0.3544)] * 2, strict=True
    ):
        impulse = law(u, UP, k, 1.0, 0.75)
        assert u + k @ impulse == pytest.approx([slip, 0.0, (u + k @ impulse)[2]], abs=5e-5)
        assert impact_energy(u, impulse, k) == pytest.approx(gained, abs=5e-5)
