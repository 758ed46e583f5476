"""What makes no world is refused, by its name and with the value that is wrong."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.world.bodies import make_bodies, make_state
from solutions.world.mass import in_principal_axes
from solutions.world.memory import NOTHING
from solutions.world.rules import Rules
from solutions.world.run import run_world
from solutions.world.simple_contacts import candidate_pairs
from solutions.world.step import advance_world

INF, NAN = np.inf, np.nan
FLOOR = ("half-space", (0.0, 0.0, 1.0))
CORNERS = np.array([(0.0, 0.0, 0.0), (0.5, 0.0, 0.0), (0.1, 0.4, 0.0), (0.2, 0.1, 0.4)])
INWARDS = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]
OUTWARDS = [face[::-1] for face in INWARDS]
DENT = np.vstack([CORNERS, [(0.2, 0.12, 0.1)]])
DENTED = [*OUTWARDS[:3], (0, 3, 4), (3, 2, 4), (2, 0, 4)]
DOWN = (0.0, 0.0, -9.81)


def two(**others):
    shapes = [("box", (0.1, 0.2, 0.3)), ("sphere", 0.2)]
    return make_bodies(shapes, [1.0, 2.0], [[0.1, 0.2, 0.2], [0.3] * 3], **others)


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"restitution": 1.5}, "restitution must be from 0 to 1, not 1.5"),
        ({"friction": INF}, "friction must be finite, not inf"),
        ({"friction": 0.5, "static_friction": 0.3}, "below friction, not 0.3 where friction is 0.5"),
        ({"material": -1}, "material must be zero or positive, not -1"),
        ({"material": 0.5}, "material must be a whole number, not 0.5"),
        ({"group": NAN}, "group must be a whole number, not nan"),
        ({"material": [0, 1, 0]}, r"material must have the shape \(2,\)"),
        ({"restitution": [[0.1, 0.9], [0.2, 0.3]]}, "either order, not 0.9 and 0.2 for 0 and 1"),
        ({"collide": [[True, False], [True, True]]}, "collide must be the same"),
        (
            {"restitution": [0.2, 0.9]},
            r"one value, or a table .* not \(2,\): .* material=range\(2\), .*np.sqrt\(np.outer",
        ),
        ({"friction": [0.2, 0.9, 0.3], "material": [2, 0]}, r"friction must be one value, .* material=range\(3\)"),
        ({"restitution": [[0.5, 0.6]]}, r"restitution must be one value, or a table .* not \(1, 2\)"),
    ],
)
def test_coefficients_that_no_pair_of_materials_has_are_refused(given, says):
    with pytest.raises(ValueError, match=says):
        two(**given)


@pytest.mark.parametrize("moments", [(0.1, 0.2, 0.301), (0.9, 0.2, 0.2), (0.0, 1.0, 0.0), (1e-9, 3e-9, 1e-9)])
def test_moments_that_no_body_can_have_are_refused(moments):
    with pytest.raises(ValueError, match=r"moments must not exceed the sum of the two others, as in .* of body 1"):
        make_bodies([("sphere", 0.1)] * 3, [1.0] * 3, [(0.3, 0.3, 0.3), moments, (0.2, 0.3, 0.4)])


@pytest.mark.parametrize(
    "moments", [(0.1, 0.2, 0.3), (1.0, 0.0, 1.0), (0.0, 0.0, 0.0), (INF, 0.1, 0.1), (0.1, 0.2, INF)]
)
def test_a_flat_plate_a_rod_a_point_and_a_body_on_an_axle_have_possible_moments(moments):
    moments = np.array(moments, dtype=np.float32)  # rounded to seven digits
    made = make_bodies([("sphere", 0.1)] * 2, [1.0, INF], [moments, (9.0, 1.0, 1.0)])
    assert made.moments[0].tolist() == moments.tolist()


def test_a_polyhedron_that_can_be_moved_is_told_about_its_centre_of_mass():
    tetrahedron = ("polyhedron", CORNERS, OUTWARDS)
    with pytest.raises(
        ValueError, match=r"of body 1 must have its centre of mass at its origin, not at 0.2, 0.125, 0.1"
    ):
        make_bodies([FLOOR, tetrahedron], [INF, 1.0], np.ones((2, 3)))
    shape, moments, *_ = in_principal_axes(tetrahedron, 1.0)
    make_bodies([shape, tetrahedron], [1.0, INF], [moments, moments])
    # One that is loaded at its tip, say, is a compound: where its centre of mass is nobody can tell from its shape
    make_bodies([("compound", [(tetrahedron, (0, 0, -0.2), (1, 0, 0, 0))])], [1.0], [moments])


def test_a_table_may_know_more_materials_than_the_bodies_use():
    table = [[0.1, 0.2, 0.3], [0.2, 0.4, 0.5], [0.3, 0.5, 0.6]]
    assert two(material=[0, 1], restitution=table).surfaces.restitution.tolist() == table


@pytest.mark.parametrize(
    ("shape", "says"),
    [
        ("sphere", "must be a tuple that begins with sphere, capsule, .* compound, not 'sphere'"),
        (("cylinder", 0.1, 0.2), "must be a tuple that begins with sphere, .* not 'cylinder'"),
        (("capsule", 0.1), "capsule needs radius, half_length, not 1"),
        (("compound", ()), "compound must have parts"),
        (("compound", [(("sphere", 0.1), (0, 0, NAN), (1, 0, 0, 0))]), "position must be finite, not nan"),
        (FLOOR, "half-space must have an infinite mass, not 1 kg"),
        (("polyhedron", CORNERS, INWARDS), r"counterclockwise from outside, not \[0, 1, 2\]"),
        (("polyhedron", CORNERS * (1, 1, 0), OUTWARDS), "convex solid"),
        (("polyhedron", DENT, DENTED), "convex solid"),
        (("polyhedron", CORNERS, [*OUTWARDS[:3], (0, 3, 9)]), "faces must name vertices 0 to 3, not 9"),
        (("polyhedron", CORNERS, [*OUTWARDS[:3], (0, 3, -2)]), "faces must name vertices 0 to 3, not -2"),
        (("polyhedron", CORNERS, OUTWARDS[:3]), "faces must bound a solid"),
        (("polyhedron", CORNERS, []), "faces must be lists of whole numbers"),
    ],
)
def test_what_is_no_shape_of_a_body_is_refused(shape, says):
    with pytest.raises(ValueError, match=says):
        make_bodies([shape], [1.0], [[0.1] * 3])


@pytest.mark.parametrize(
    ("state", "says"),
    [
        ({"position": (0.0, 0.0, 1.0)}, r"position must have the shape \(n, 3\), not \(3,\)"),
        ({"position": np.zeros((2, 2, 3))}, r"position must have the shape \(n, 3\), not \(2, 2, 3\)"),
        ({"position": np.zeros((2, 3)), "orientation": (1, 0, 0)}, r"orientation must have the shape \(2, 4\)"),
        ({"position": np.zeros((2, 3)), "velocity": np.ones((3, 3))}, r"velocity must have the shape \(2, 3\)"),
    ],
)
def test_a_state_that_is_not_that_of_n_bodies_is_refused(state, says):
    with pytest.raises(ValueError, match=says):
        make_state(**state)


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"dt": 0.0}, "dt must be positive, not 0"),
        ({"dt": -0.01}, "dt must be positive, not -0.01"),
        ({"dt": "a"}, "dt must be real numbers, not 'a'"),
        ({"dt": [0.01, 0.02]}, r"dt must have the shape \(\), .* not \(2,\)"),
        ({"acceleration": np.array([0, 0, 1j])}, r"acceleration must be real numbers, not array\(\[0"),
        ({"memory": None}, "memory must be what another step left, .* not NoneType"),
        (
            {"memory": NOTHING._replace(still=np.zeros(3)), "rules": Rules(sleep_speed=0.1)},
            r"memory.still must have the shape \(2,\)",
        ),
        ({"acceleration": -9.81}, "acceleration must have shape"),
        ({"acceleration": (0, 0, -INF)}, "acceleration must be finite, not -inf"),
        ({"force": NAN * np.ones((2, 3))}, "force must be finite, not nan"),
        ({"torque": np.ones((3, 3))}, r"torque must have the shape \(2, 3\)"),
        (
            {"state": make_state([(0, 0, 1)])},
            r"position must have the shape \(2, 3\), that of 2 bodies, not \(1, 3\)",
        ),
        (
            {"state": make_state([(0, 0, 1), (0, 0, 2)])._replace(velocity=np.zeros((2, 2)))},
            r"velocity must have the shape \(2, 3\)",
        ),
        ({"rules": Rules(recovery=2.0)}, "recovery must be from 0 to 1, not 2"),
        ({"rules": Rules(sweeps=2.5)}, "sweeps must be a whole number, not 2.5"),
        ({"rules": Rules(rest_speed=-1.0)}, "rest_speed must be zero or positive, not -1"),
        ({"rules": Rules(margin=INF)}, "margin must be finite, not inf"),
        ({"rules": Rules(directions=7)}, "directions must be an even number from 4, not 7"),
        ({"rules": Rules(stiffness=-1.0)}, "stiffness must be positive, not -1"),
        ({"rules": Rules(sleep_speed=0.1, sleep_after=0.0)}, "sleep_after must be positive, not 0"),
        ({"rules": Rules(sleep_speed=0.1, response="in time order")}, "sleep_speed must be 0 with the response"),
    ],
)
def test_a_step_that_no_world_can_take_is_refused(given, says):
    usual = {"bodies": two(), "state": make_state([(0, 0, 1), (1, 2, 3)]), "acceleration": DOWN, "dt": 0.01}
    with pytest.raises(ValueError, match=says):
        advance_world(**{**usual, **given})


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"steps": -1}, "steps .* from 0, not -1"),
        ({"every": 0}, "not 0"),
        ({"steps": True}, "steps .* not True"),
        ({"dt": "a"}, "dt must be real numbers, not 'a'"),
    ],
)
def test_a_run_of_no_number_of_steps_is_refused(given, says):
    with pytest.raises(ValueError, match=says):
        run_world(two(), make_state([(0, 0, 1), (1, 2, 3)]), DOWN, **{"dt": 0.01, "steps": 3, **given})


def test_a_motion_beyond_all_numbers_and_a_box_turned_inside_out_are_refused():
    far = make_state([(0, 0, 1), (1.7e308, 2, 3)], velocity=[(0, 0, 0), (1e308, 0, 0)])
    with np.errstate(all="ignore"), pytest.raises(ValueError, match="the motion is not finite at 10 s"):
        run_world(two(), far, DOWN, 10.0, 3)
    with pytest.raises(ValueError, match="lower must not be above upper"):
        candidate_pairs([[0.0, 0.0, 2.0]], [[1.0, 1.0, 1.0]])
