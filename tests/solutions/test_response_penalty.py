from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from reference import truth
from solutions import as_printed
from solutions.detection import signed_distance
from solutions.forces import semi_implicit_euler
from solutions.response import (
    penalty_damping,
    penalty_force,
    penalty_rest_depth,
    penalty_restitution,
    penalty_step_limit,
)

G = 9.81
UP = (0.0, 0.0, 1.0)
RATIOS = [0.0, 0.01, 0.3, 0.7, 0.99, 1 - 1e-9, 1.0, 1 + 1e-9, 1.01, 2.0, 10.0]
MASS, STIFFNESS = 0.3, 5000.0
MASSES, STIFFNESSES = st.floats(1e-3, 1e3), st.floats(1e-2, 1e9)


def damping(ratio, mass=MASS, stiffness=STIFFNESS):
    return 2 * ratio * math.sqrt(stiffness * mass)


# The force


@pytest.mark.statement(8, oracle="arithmetic by hand")
def test_a_penalty_floor_pushes_with_k_d_plus_its_damping():
    force = penalty_force([-0.25, -0.25, -0.25], [0.0, -2.0, 2.0], (0.6, 0.0, 0.8), 80.0, 5.0)
    assert force == pytest.approx(np.outer([20.0, 30.0, 10.0], (0.6, 0.0, 0.8)), abs=1e-14)  # rounding of tens


@pytest.mark.statement(8, oracle="the sign of the force")
def test_only_an_adhesive_contact_pulls_and_none_acts_from_afar():
    leaving = (-0.25, 6.0, UP, 80.0, 5.0)  # spring 20 N, dashpot −30 N
    assert penalty_force(*leaving).tolist() == [0.0, 0.0, 0.0]
    assert penalty_force(*leaving, adhesive=True).tolist() == [0.0, 0.0, -10.0]
    for adhesive in (False, True):
        assert np.all(penalty_force([0.5, 0.0], [-9.0, -9.0], UP, 80.0, 5.0, adhesive) == 0)


@given(st.floats(-1, 1), st.floats(-10, 10), st.floats(0, 1e4), st.floats(0, 1e2))
def test_the_penalty_force_is_that_of_its_definition(s, v, k, c):
    expected = max(0.0, -k * s - c * v) if s < 0 else 0.0
    assert penalty_force(s, v, UP, k, c).tolist() == [0.0, 0.0, pytest.approx(expected, rel=1e-14, abs=1e-300)]


def test_without_damping_the_force_is_the_slides_spring_with_a_direction():
    assert penalty_force(-0.25, -3.0, UP, 80.0).tolist() == [0.0, 0.0, 20.0]


# At rest


@pytest.mark.statement(8, oracle="balance of weight and spring, and a settled simulation")
def test_a_body_settles_where_the_spring_carries_its_weight():
    depth = penalty_rest_depth(MASS, G, STIFFNESS)
    assert penalty_force(-depth, 0.0, UP, STIFFNESS)[2] == pytest.approx(MASS * G, rel=1e-15)
    position, velocity = np.array([0.0, 0.0, 0.01]), np.zeros(3)
    c, dt = damping(0.7), 1e-4
    for _ in range(4_000):  # 0.4 s, some 36 times the decay time 1/(ζω)
        force = penalty_force(position[2], velocity[2], UP, STIFFNESS, c)
        position, velocity = semi_implicit_euler(position, velocity, force / MASS - G * np.array(UP), dt)
    assert position[2] == pytest.approx(-depth, rel=1e-12)
    assert penalty_rest_depth([0.0, 1.0, 2.0], 10.0, 1000.0).tolist() == [0.0, 0.01, 0.02]


# The impact


def impact(ratio, adhesive, speed=1.0, mass=MASS, stiffness=STIFFNESS):
    """Restitution of an impact, by a solver of differential equations with an event at its end."""
    integrate = oracle("scipy.integrate")
    c, omega = damping(ratio, mass, stiffness), math.sqrt(stiffness / mass)

    def force(state):
        return -stiffness * state[0] - c * state[1]

    def lets_go(_, state):
        return state[0] if adhesive else force(state)

    lets_go.terminal, lets_go.direction = True, 1 if adhesive else -1
    found = integrate.solve_ivp(
        lambda _, state: (state[1], force(state) / mass),
        (0, (20 + 20 * ratio) / omega),
        (-1e-15 * speed / omega, -speed),  # within rounding of the surface, or the event might see its own start
        method="DOP853",
        events=lets_go,
        rtol=1e-13,
        atol=1e-15 * speed / omega,
    )
    assert found.status == 1
    return found.y[1, -1] / speed


@pytest.mark.statement(8, oracle="scipy's solve_ivp, DOP853 with an event where the force ends")
@pytest.mark.parametrize("ratio", RATIOS)
def test_an_impact_that_cannot_pull_ends_as_in_solve_ivp(ratio):
    e = impact(ratio, adhesive=False)
    c = damping(ratio)
    # The solver's tolerance of 1e-13 a step, over some ten steps
    assert penalty_restitution(MASS, STIFFNESS, c) == pytest.approx(e, rel=3e-12)


@pytest.mark.statement(8, oracle="scipy's solve_ivp, DOP853 with an event at the surface")
@pytest.mark.parametrize("ratio", [0.0, 0.01, 0.3, 0.7])
def test_an_adhesive_impact_ends_as_in_solve_ivp(ratio):
    e = impact(ratio, adhesive=True)
    c = damping(ratio)
    assert penalty_restitution(MASS, STIFFNESS, c, adhesive=True) == pytest.approx(e, rel=3e-12)


@pytest.mark.statement(8, oracle="exp[−(ζ/s)(π − atan2(2ζs, 1 − 2ζ²))], written out in the standard library")
@pytest.mark.parametrize("ratio", RATIOS)
def test_the_restitution_is_the_closed_form_in_all_three_regimes(ratio):
    # The reference rounds ζ², and so loses ε/|1 − ζ²| near ζ = 1; at 1 it takes the limit
    near = 1e-13 + (0.0 if ratio == 1 else 2.3e-16 / abs(1 - ratio**2))
    e = truth.spring_dashpot_restitution(ratio)
    assert penalty_restitution(MASS, STIFFNESS, damping(ratio)) == pytest.approx(e, rel=near)


def test_a_critically_damped_contact_leaves_e_to_the_minus_two():
    c = 2 * math.sqrt(64.0 * 4.0)
    assert penalty_restitution(4.0, 64.0, c) == math.exp(-2)


def test_an_undamped_contact_is_elastic():
    for adhesive in (False, True):
        assert penalty_restitution(4.0, 64.0, 0.0, adhesive) == 1.0


def test_an_adhesive_contact_without_swings_never_lets_go():
    c = damping(1.0) * np.array([1.0, 1.5])
    assert penalty_restitution(MASS, STIFFNESS, c, adhesive=True).tolist() == [0.0, 0.0]


@given(st.floats(0, 0.999))
def test_adhesion_takes_speed(ratio):
    c = damping(ratio)
    free, held = penalty_restitution(MASS, STIFFNESS, c), penalty_restitution(MASS, STIFFNESS, c, adhesive=True)
    assert held <= free


@pytest.mark.statement(8, oracle="MuJoCo's spring contact, small steps")
@pytest.mark.parametrize("ratio", [0.05, 0.3, 0.7])
def test_mujocos_spring_contact_leaves_the_same_speed(ratio, installed):
    mujoco = installed("mujoco").module()
    k, dt, speed = 1e4, 2e-6, 1.0  # per unit mass, 1/s²
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><option timestep="{dt}" gravity="0 0 0" cone="elliptic"/>
        <worldbody><geom name="floor" type="plane" size="1 1 1"/>
        <body pos="0 0 .100001"><freejoint/><geom name="ball" type="sphere" size=".1" mass="1"/></body></worldbody>
        <contact><pair geom1="floor" geom2="ball" condim="1" solimp=".9999 .9999 .001"
        solref="{-k} {-2 * ratio * math.sqrt(k)}"/></contact></mujoco>""")
    data = mujoco.MjData(model)
    data.qvel[2] = -speed
    mujoco.mj_step(model, data, nstep=round(0.06 / dt))  # contact lasts 31 ms at most
    # MuJoCo's impedance of 0.9999 and a step of ωΔt = 2e-4 shift spring and dashpot by some 1e-4, in part both alike
    assert data.qvel[2] / speed == pytest.approx(penalty_restitution(1.0, k, 2 * ratio * math.sqrt(k)), abs=1e-4)


# The damping for a wanted restitution


@pytest.mark.statement(8, oracle="the closed form inverted by another bisection")
@given(st.floats(0.001, 1), MASSES, STIFFNESSES)
def test_another_bisection_finds_the_same_damping(e, mass, stiffness):
    c = penalty_damping(e, mass, stiffness)
    # Both halve until nothing is left to halve; near e = 1, ζ is known to some ε/(1 − e)
    ratio = truth.damping_ratio(e)
    assert c == pytest.approx(
        2 * ratio * math.sqrt(mass * stiffness), rel=1e-12, abs=1e-15 * math.sqrt(mass * stiffness)
    )


@given(st.floats(1e-9, 1), MASSES, STIFFNESSES, st.booleans())
def test_the_damping_for_a_wanted_restitution_gives_it(e, mass, stiffness, adhesive):
    c = penalty_damping(e, mass, stiffness, adhesive)
    # ln e comes back to some ε of itself, and of ζ at the other end
    assert penalty_restitution(mass, stiffness, c, adhesive) == pytest.approx(e, rel=1e-12)


def test_the_formula_of_lammps_gives_the_adhesive_contact():
    e = 0.9
    beta = -math.log(e) / math.sqrt(math.pi**2 + math.log(e) ** 2)
    assert penalty_damping(e, 4.0, 64.0, adhesive=True) == pytest.approx(32 * beta, rel=1e-15)


def test_an_elastic_contact_needs_no_damping_and_a_dead_one_infinite():
    assert penalty_damping([1.0, 0.0], 4.0, 64.0).tolist() == [0.0, math.inf]
    assert penalty_damping([1.0, 0.0], 4.0, 64.0, adhesive=True).tolist() == [0.0, 32.0]


# The step


def step_matrix(dt, mass, stiffness, c):
    """(x, v) → (x, v) after one semi-implicit step of m x″ = −k x − c x′, made from the step itself."""
    columns = []
    for x, v in np.eye(2):
        force = -stiffness * x - c * v
        position, velocity = semi_implicit_euler((0, 0, x), (0, 0, v), (0, 0, force / mass), dt)
        columns.append((position[2], velocity[2]))
    return np.transpose(columns)


@pytest.mark.statement(8, oracle="spectral radius of the step matrix")
@given(st.floats(0, 20), MASSES, STIFFNESSES)
def test_the_step_limit_is_where_the_spectral_radius_passes_one(ratio, mass, stiffness):
    c = damping(ratio, mass, stiffness)
    limit = penalty_step_limit(mass, stiffness, c)
    below, above = (
        np.abs(np.linalg.eigvals(step_matrix(share * limit, mass, stiffness, c))).max() for share in (0.999, 1.001)
    )
    assert below <= 1 + 1e-7  # without damping it is 1, a double eigenvalue near the limit: known to √ε
    assert above > 1 + 1e-5


@pytest.mark.statement(8, oracle="simulations on both sides of the limit")
def test_a_pressed_contact_rests_only_below_the_step_limit():
    c = damping(np.array([0.0, 0.1, 0.5, 1.0, 3.0]))
    dt = np.array([[0.98], [1.02]]) * penalty_step_limit(MASS, STIFFNESS, c)  # two rows: below and above the limits
    depth = float(penalty_rest_depth(MASS, G, STIFFNESS))
    position, velocity, largest = np.zeros((2, 5, 3)), np.zeros((2, 5, 3)), np.zeros((2, 5))
    position[..., 2] = -depth * (1 - 1e-6)
    for _ in range(1000):
        force = penalty_force(position[..., 2], velocity[..., 2], UP, STIFFNESS, c)
        position, velocity = semi_implicit_euler(position, velocity, force / MASS - G * np.array(UP), dt)
        largest = np.maximum(largest, np.abs(position[..., 2] / depth + 1))
    # Without damping the orbit of the step matrix is 1/√(1 − (ωΔt/2)²) = 5 times as wide as what it was nudged by
    assert np.all(largest[0] <= 1e-5)
    # Nudged by a millionth. How far it goes is up to the clamp: in the air nothing shakes, and a damped body hops on.
    assert np.all(largest[1] > 0.01)


def test_the_step_limit_falls_from_two_over_omega_to_two_m_over_c():
    assert penalty_step_limit(4.0, 64.0) == 0.5
    assert penalty_step_limit(4.0, 64.0, 1e9) == pytest.approx(8e-9, rel=1e-12)
    assert penalty_step_limit(4.0, 64.0, 24.0) == pytest.approx(0.25, rel=1e-15)  # ζ = 3/4: √(1 + ζ²) = 5/4


# The slide as printed


@pytest.mark.erratum(8)
def test_as_printed_a_signed_distance_pulls_the_body_deeper_in():
    inside, outside = (signed_distance((0, 0, z), UP, 0.0) for z in (-0.1, 0.1))
    assert as_printed.penalty_force(80.0, inside) == -8.0  # along N: into the floor
    assert as_printed.penalty_force(80.0, outside) == 8.0  # from 10 cm above it
    assert penalty_force([inside, outside], 0.0, UP, 80.0)[:, 2].tolist() == [8.0, 0.0]


@pytest.mark.erratum(8)
def test_as_printed_without_damping_the_body_bounces_forever():
    dt, z, v, apexes = 1e-5, 0.05, 0.0, []
    for _ in range(80_000):
        force = as_printed.penalty_force(STIFFNESS, max(0.0, -z))  # depth and direction put right
        before, v = v, v + (force / MASS - G) * dt
        z += v * dt
        if before > 0 >= v and z > 0:
            apexes.append(z)
    assert len(apexes) == 3
    assert apexes == pytest.approx([0.05] * 3, rel=0.01)  # steps of 1e-5: about v Δt/h a bounce
    assert penalty_restitution(MASS, STIFFNESS, damping(0.3)) < 0.5  # what a dashpot takes


@pytest.mark.erratum(8)
def test_without_the_clamp_a_damped_contact_holds_the_body_back():
    # Depth 1 mm, 1 m/s outwards: 5 N of spring against the dashpot's 23 N
    c = damping(0.3)
    assert penalty_force(-1e-3, 1.0, UP, STIFFNESS, c, adhesive=True)[2] < -17
    assert penalty_force(-1e-3, 1.0, UP, STIFFNESS, c)[2] == 0


# What is refused, and one is many


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: penalty_force(math.nan, 0.0, UP, 1.0, 1.0), "separation must be finite, not nan"),
        (lambda: penalty_force(-1.0, math.nan, UP, 1.0, 1.0), "normal_velocity must be finite, not nan"),
        (lambda: penalty_force(-1.0, 0.0, (0, 0, 2), 1.0, 1.0), "normal must have length 1, not 2"),
        (lambda: penalty_force(-1.0, 0.0, 1.0, 1.0, 1.0), r"normal must have shape \(..., 3\)"),
        (lambda: penalty_force(-1.0, 0.0, UP, -1.0, 1.0), "stiffness must be zero or positive, not -1"),
        (lambda: penalty_force(-1.0, 0.0, UP, math.inf, 1.0), "stiffness must be finite, not inf"),
        (lambda: penalty_force(-1.0, 0.0, UP, 1.0, -1.0), "damping must be zero or positive, not -1"),
        (lambda: penalty_force(-1.0, 0.0, UP, 1.0, math.inf), "damping must be finite, not inf"),
        (lambda: penalty_rest_depth(-1.0, 1.0, 1.0), "mass must be zero or positive, not -1"),
        (lambda: penalty_rest_depth(1.0, -1.0, 1.0), "gravity must be zero or positive, not -1"),
        (lambda: penalty_rest_depth(1.0, 1.0, 0.0), "stiffness must be positive, not 0"),
        (lambda: penalty_restitution(0.0, 1.0, 1.0), "mass must be positive, not 0"),
        (lambda: penalty_restitution(math.inf, 1.0, 1.0), "mass must be finite, not inf"),
        (lambda: penalty_restitution(1.0, math.inf, 1.0), "stiffness must be finite, not inf"),
        (lambda: penalty_restitution(1.0, 0.0, 1.0), "stiffness must be positive, not 0"),
        (lambda: penalty_restitution(1.0, 1.0, -1.0), "damping must be zero or positive, not -1"),
        (lambda: penalty_restitution(1.0, 1.0, math.inf), "damping must be finite, not inf"),
        (lambda: penalty_damping(1.5, 1.0, 1.0), "restitution must be from 0 to 1, not 1.5"),
        (lambda: penalty_damping(0.5, 0.0, 1.0), "mass must be positive, not 0"),
        (lambda: penalty_damping(0.5, 1.0, -2.0), "stiffness must be positive, not -2"),
        (lambda: penalty_step_limit(-1.0, 1.0, 1.0), "mass must be positive, not -1"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name_and_value(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def everything(separation, velocity, normal, mass, stiffness, c, e):
    return (
        penalty_force(separation, velocity, normal, stiffness, c),
        penalty_force(separation, velocity, normal, stiffness, c, adhesive=True),
        penalty_rest_depth(mass, e, stiffness),
        *(penalty_restitution(mass, stiffness, c, adhesive) for adhesive in (False, True)),
        *(penalty_damping(e, mass, stiffness, adhesive) for adhesive in (False, True)),
        penalty_step_limit(mass, stiffness, c),
    )


def contacts(shape):
    rng = np.random.default_rng(6)
    normal = rng.normal(size=(*shape, 3))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    mass, stiffness, c, e = rng.uniform(0.01, 1, size=(4, *shape))  # damping ratios from 0.01 to 50
    return *rng.normal(size=(2, *shape)), normal, mass, stiffness, c, e


def test_many_contacts_at_once_are_the_same_as_one_after_another():
    scene = contacts((4, 5))
    together = everything(*scene)
    assert {values.shape for values in together} == {(4, 5, 3), (4, 5)}
    for at in np.ndindex(4, 5):
        for values, one in zip(together, everything(*(part[at] for part in scene)), strict=True):
            assert values[at] == pytest.approx(one, rel=1e-13)  # vectorised exp and arccos may round otherwise


def test_one_ball_meets_many_floors():
    assert penalty_force(-0.5, 0.0, UP, [2.0, 4.0])[:, 2].tolist() == [1.0, 2.0]
    assert penalty_damping([1.0, 1.0], 4.0, [[1.0], [4.0]]).shape == (2, 2)


def test_penalty_functions_change_none_of_their_inputs():
    scene = contacts((6,))
    kept = [array.copy() for array in scene]
    for array in scene:
        array.flags.writeable = False  # writing to one would raise
    everything(*scene)
    assert all(np.array_equal(array, copy) for array, copy in zip(scene, kept, strict=True))


def test_the_damping_of_a_contact_that_loses_next_to_nothing_has_all_its_digits():
    # ζ (π/2 − ζ) = L/2 for a small loss L = −ln e, so that ζ = L/π + 2 L²/π³, but for a share L²
    loss = np.array([1e-6, 3e-9, 1e-13])
    e = np.exp(-loss)
    loss = -np.log(e)  # as the float has it
    ratio = loss / np.pi + 2 * loss**2 / np.pi**3
    found = penalty_damping(e, 1.3, 700.0)
    np.testing.assert_allclose(found, 2 * ratio * np.sqrt(1.3 * 700.0), rtol=5e-12)
    assert str(penalty_damping(1.0, 1.3, 700.0)) == "0.0"
