from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from solutions.detection import count_impacts

EIGHTHS = st.integers(-80, 80).map(lambda value: value / 8)
LENGTH, STEP = st.integers(1, 24).map(lambda value: value / 8), st.floats(0.01, 2)
SHARE, STEPS = st.integers(0, 16).map(lambda value: value / 16), st.integers(1, 60)
ROUNDING = 1e-10  # m, of ways up to 1200 m that are gone in some 10,000 pieces


def mirror_images(position, velocity, length, duration):
    """Walls passed and place in the strip of a puck that goes straight on, through copies of the strip, in fractions.

    Also how far it is from the nearest wall in the end, where rounding may decide whether it has passed it.
    """
    x, v, length = (Fraction(value) for value in (position, velocity, length))
    way = v * Fraction(duration)
    place = (x + way) % (2 * length)
    # Half-open strips: a puck that reaches a wall has hit it, and one that starts on it and moves away has not
    passed = (x + way) // length - x // length if v > 0 else (-x - way) // length - (-x) // length
    starts_into_it = v != 0 and x == (length if v > 0 else 0)
    return passed + starts_into_it, min(place, 2 * length - place), abs((x + way) / length - round((x + way) / length))


@pytest.mark.statement(3, oracle="mirror images of the strip between the walls, in exact fractions")
@given(SHARE, EIGHTHS, LENGTH, STEP, STEPS)
def test_impacts_are_the_walls_of_mirror_images_for_any_step(share, velocity, length, dt, steps):
    passed, place, from_a_wall = mirror_images(share * length, velocity, length, steps * Fraction(dt))
    assume(velocity == 0 or from_a_wall > ROUNDING)
    count, position = count_impacts(share * length, velocity, length, dt, steps * dt)
    assert count == passed
    assert position == pytest.approx(float(place), abs=ROUNDING)


@pytest.mark.parametrize(
    ("motion", "expected"),
    [
        ((0.25, 0.0, 1.0, 0.5, 2.0), (0, 0.25)),
        ((1.0, 0.0, 1.0, 0.5, 2.0), (0, 1.0)),  # it touches a wall, and does not move
        ((0.0, -0.5, 1.0, 0.5, 1.0), (1, 0.5)),  # on a wall, moving into it
        ((0.0, 0.5, 1.0, 0.5, 1.0), (0, 0.5)),  # on a wall, moving away
        ((0.5, 1.0, 1.0, 0.25, 0.5), (1, 1.0)),  # it arrives with the last step
        ((0.5, 1.0, 1.0, 0.25, 1.5), (2, 0.0)),  # each step ends on a wall or half way
        ((0.0, 3.0, 1.0, 1.0, 2.0), (6, 0.0)),  # three whole crossings in each step
        ((0.0, -1.0, 1.0, 1.0, 0.0), (0, 0.0)),  # no step is made
        ((0.25, 5e-324, 1.0, 0.5, 1.0), (0, 0.25)),  # it would arrive after more seconds than a float holds
        ((0.5, 2.0, 1.0, 0.1, 0.3), (1, 0.9)),  # 0.3/0.1 is just below 3
    ],
)
def test_impacts_at_rest_on_a_wall_and_at_the_end_of_a_step(motion, expected):
    count, position = count_impacts(*motion)
    assert (count, position) == (expected[0], pytest.approx(expected[1], abs=1e-15))
    assert type(count) is int


@pytest.mark.parametrize(
    ("motion", "message"),
    [
        ((math.nan, 1.0, 1.0, 0.1, 1.0), "position must be finite, not nan"),
        ((0.5, math.inf, 1.0, 0.1, 1.0), "velocity must be finite, not inf"),
        ((0.5, 1.0, 0.0, 0.1, 1.0), "length must be positive, not 0"),
        ((0.5, 1.0, math.inf, 0.1, 1.0), "length must be finite, not inf"),
        ((0.5, 1.0, 1.0, 0.0, 1.0), "dt must be positive, not 0"),
        ((0.5, 1.0, 1.0, math.inf, 1.0), "dt must be finite, not inf"),
        ((0.5, 1.0, 1.0, 0.1, -1.0), "duration must be zero or positive, not -1"),
        ((0.5, 1.0, 1.0, 0.1, math.inf), "duration must be finite, not inf"),
        ((2.5, 1.0, 2.0, 0.1, 1.0), "position must be from 0 to 2, not 2.5"),
        ((-0.5, 1.0, 2.0, 0.1, 1.0), "position must be from 0 to 2, not -0.5"),
    ],
)
def test_a_puck_that_makes_no_sense_is_refused(motion, message):
    with pytest.raises(ValueError, match=message):
        count_impacts(*motion)
