from __future__ import annotations

import dataclasses
import math
from fractions import Fraction
from typing import get_args

import numpy as np
import pytest

from reference import lecture
from reference.errors import UnknownName
from reference.lecture import FUNCTIONS, STATEMENTS, TOPICS

FOOT = 0.3048  # m, by definition
STANDARD_GRAVITY = 9.80665  # m/s², by definition
EARTH = 3.986004418e14  # G M of the Earth, m³/s² (WGS 84)
MEAN_RADIUS = 6371e3  # m


def test_the_lecture_has_thirty_statements_numbered_consecutively():
    assert [entry.number for entry in STATEMENTS] == list(range(1, 31))


def test_the_topics_are_taught_from_one_bounce_to_a_whole_world():
    order = "detection response friction impulse polyhedra sweeping forces meshes avoidance world"
    assert [entry.name for entry in TOPICS] == order.split()


def test_every_title_is_short_and_used_once():
    for entries in (TOPICS, STATEMENTS):
        titles = [entry.title for entry in entries]
        assert len(set(titles)) == len(titles)
        assert all(1 <= len(title.split()) <= 6 for title in titles)


def test_every_statement_belongs_to_a_topic_and_every_topic_has_a_statement():
    assert {entry.topic for entry in STATEMENTS} == {entry.name for entry in TOPICS}


@pytest.mark.parametrize("entry", STATEMENTS, ids=lambda entry: str(entry.number))
def test_every_statement_says_what_the_slide_says_and_what_is_right(entry):
    assert entry.slide
    assert entry.right
    assert entry.slide != entry.right
    for text in (entry.title, entry.slide, entry.right, entry.erratum):
        assert text == " ".join(text.split()), "a line of the text was joined to the next with a wrong blank"


def test_statements_that_the_slides_get_right_have_no_erratum():
    assert [entry.number for entry in STATEMENTS if not entry.erratum] == [2, 6, 10, 11, 17, 19, 23, 28]


def test_every_function_belongs_to_a_topic_and_a_statement():
    for name, entry in FUNCTIONS.items():
        assert entry.name == name
        assert name.isidentifier()
        assert lecture.topic(entry.topic).name == entry.topic, name
        assert lecture.statement(entry.statement).number == entry.statement, name
        assert entry.role in get_args(lecture.Role), name


@pytest.mark.parametrize("topic", [entry.name for entry in TOPICS])
def test_the_steps_of_a_topic_count_from_one_without_gaps(topic):
    found = lecture.functions_of(topic)
    steps = sorted(step for entry in found for step in {entry.first_step, entry.step})
    assert list(dict.fromkeys(steps)) == list(range(1, len(set(steps)) + 1))
    assert set(found) == {entry for entry in FUNCTIONS.values() if entry.topic == topic}


def test_detection_goes_from_distance_to_exact_time_of_impact():
    names = [entry.name for entry in lecture.functions_of("detection") if entry.role == "written"][:5]
    first = ["signed_distance", "side_of_plane", "time_of_impact_interpolated"]
    assert names == [*first, "count_impacts", "time_of_impact_exact"]


def test_drivers_use_given_functions_and_formulas_are_to_be_written():
    given = {name for name, entry in FUNCTIONS.items() if entry.role == "given"}
    assert given >= {"uniform_gravity", "ballistic_motion", "semi_implicit_euler"}
    assert {entry.role for entry in FUNCTIONS.values()} == set(get_args(lecture.Role))
    written = {entry.statement for entry in FUNCTIONS.values() if entry.role == "written"}
    assert written >= {1, 4, 5, 7, 8, 24, 25, 26, 27, 28, 29}


@pytest.mark.parametrize(
    ("look_up", "wrong", "choices"),
    [
        (lecture.statement, 31, [str(number) for number in range(1, 31)]),
        (lecture.statement, 0, ["1", "30"]),
        (lecture.function, "signed_distanse", list(FUNCTIONS)),
        (lecture.topic, "detektion", [entry.name for entry in TOPICS]),
        (lecture.functions_of, "collision", [entry.name for entry in TOPICS]),
    ],
)
def test_looking_up_a_wrong_name_reports_it_and_the_choices(look_up, wrong, choices):
    with pytest.raises(UnknownName) as caught:
        look_up(wrong)
    assert str(wrong) in str(caught.value)
    assert set(choices) <= set(caught.value.choices)
    assert all(choice in str(caught.value) for choice in choices)


@pytest.mark.parametrize(
    "entry", [TOPICS[0], STATEMENTS[0], FUNCTIONS["holds"]], ids=["topic", "statement", "function"]
)
def test_the_lecture_cannot_be_changed_by_its_readers(entry):
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(entry, dataclasses.fields(entry)[0].name, "changed")


# The numbers in the texts, computed again.


def test_thirty_two_feet_a_second_squared_is_less_than_standard_gravity():
    erratum = lecture.statement(25).erratum
    assert f"32 ft/s² is {32 * FOOT:.4f} m/s²" in erratum
    assert f"{STANDARD_GRAVITY} m/s² is {STANDARD_GRAVITY / FOOT:.3f} ft/s²" in erratum


def test_newtons_law_at_the_mean_radius_gives_more_than_standard_gravity():
    gravity = EARTH / MEAN_RADIUS**2
    assert gravity > STANDARD_GRAVITY
    assert f"G M/R² is {gravity:.3f} m/s² (mean radius {MEAN_RADIUS / 1000:.0f} km" in lecture.statement(25).erratum


def test_the_interpolated_time_is_early_by_an_eighth_of_g_dt_squared_over_v():
    # Weak gravity on a fast point, g Δt/v = 1e-3: what the leading order leaves out is a share of about 1e-3.
    gravity, timestep, speed = 1e-3, 1.0, 1.0
    height = np.linspace(0.0, speed * timestep, 1001)
    end = height - speed * timestep - gravity * timestep**2 / 2
    interpolated = timestep * height / (height - end)
    exact = 2 * height / (speed + np.sqrt(speed**2 + 2 * gravity * height))
    early = exact - interpolated
    assert early.min() >= -1e-12  # rounding only: never late
    share = gravity * timestep**2 / speed / early.max()
    assert share == pytest.approx(round(share), rel=2e-3)
    assert f"early by up to g_n Δt²/({round(share)} v_n)" in lecture.statement(5).erratum


def test_penalty_contact_is_stable_up_to_the_stated_step():
    damping, frequency = 0.3, 2.0
    limit = 2 / frequency * (math.sqrt(1 + damping**2) - damping)

    def growth(dt):
        kick = np.array([[1.0, 0.0], [-(frequency**2) * dt, 1 - 2 * damping * frequency * dt]])
        drift = np.array([[1.0, dt], [0.0, 1.0]])
        return abs(np.linalg.eigvals(drift @ kick)).max()

    assert growth(0.999 * limit) < 1 < growth(1.001 * limit)
    assert "dt < (2/ω)(√(1 + ζ²) − ζ)" in lecture.statement(8).erratum


def test_a_cradle_of_five_has_two_answers_that_keep_momentum_and_energy():
    one_by_one = [1, 0, 0, 0, 0]
    for first in range(4):  # equal masses, e = 1: each pair swaps its velocities
        one_by_one[first : first + 2] = reversed(one_by_one[first : first + 2])
    striker, struck = (1 - 4) / (1 + 4), 2 / (1 + 4)  # a ball against four that move as one, e = 1
    at_once = [striker, *[struck] * 4]
    for velocities in (one_by_one, at_once):
        assert sum(velocities) == pytest.approx(1)
        assert sum(velocity**2 for velocity in velocities) == pytest.approx(1)
    erratum = lecture.statement(22).erratum
    assert f"({', '.join(map(str, one_by_one))})" in erratum
    assert f"({', '.join(map(str, at_once))})".replace("-", "−") in erratum


def test_terminal_speed_balances_weight_buoyancy_and_stokes_drag():
    share = Fraction(4, 3) / 6  # of (ρ_s − ρ_f) g r²/η: volume 4/3 π r³ over 6 π r
    text = f"v_t = {share.numerator}(ρ_s − ρ_f) g r²/({share.denominator}η)"
    assert text in lecture.statement(26).right


def test_true_drag_exceeds_stokes_by_the_stated_shares():
    def excess(reynolds):  # Clift, Grace and Weber, 0.01 < Re ≤ 20
        return 0.1315 * reynolds ** (0.82 - 0.05 * math.log10(reynolds))

    erratum = lecture.statement(26).erratum
    assert f"by {100 * excess(0.1):.1f} % at Re = 2 r ρ_f v/η = 0.1" in erratum
    assert f"by {100 * excess(1.0):.0f} % at 1 " in erratum


def cloth_step_limit(side: int, *offsets: tuple[int, int]) -> float:
    """Largest stable step of an unstressed square cloth in its plane, in √(m/k): 2 over the highest frequency."""
    stiffness = np.zeros((2 * side**2, 2 * side**2))
    for across, up in offsets:
        direction = np.array([across, up]) / math.hypot(across, up)
        for x in range(side - across):
            for y in range(max(0, -up), side - max(0, up)):
                stretch = np.zeros((side, side, 2))
                stretch[x, y], stretch[x + across, y + up] = -direction, direction
                stiffness += np.outer(stretch, stretch)
    return 2 / math.sqrt(np.linalg.eigvalsh(stiffness)[-1])


def test_each_kind_of_spring_added_to_a_cloth_shortens_its_step():
    structural, shear, bend = [(1, 0), (0, 1)], [(1, 1), (1, -1)], [(2, 0), (0, 2)]
    first = cloth_step_limit(10, *structural)
    second = cloth_step_limit(10, *structural, *shear)
    third = cloth_step_limit(10, *structural, *shear, *bend)
    right = lecture.statement(28).right
    assert f"10×10 cloth takes {first:.2f}, {second:.2f} and {third:.3f} √(m/k)" in right
    assert f"2√(m/k) is {2 / third:.0f} times too optimistic" in right


def test_the_two_meanings_of_body_are_told_apart_where_each_is_defined():
    solutions = pytest.importorskip("solutions.impulse")
    from reference.scene import scenario  # noqa: PLC0415

    assert "reference.scene.scenario" in solutions.Body.__doc__
    assert "solutions.impulse" in scenario.Body.__doc__
