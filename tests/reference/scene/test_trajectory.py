from __future__ import annotations

import math
import pickle
from dataclasses import FrozenInstanceError, fields, replace

import numpy as np
import pytest

from reference.errors import RunFailed, UnknownName
from reference.scene.scenario import Body, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Contacts, Event, Recorder, Trajectory

FLOOR = Body("floor", HalfSpace())
BALL = Body("ball", Sphere(0.1), mass=1.0)
SCENARIO = Scenario("drop", (FLOOR, BALL), (Pair("ball", "floor"),), duration=1.0)
SETTINGS = Settings(0.1)
COUNT = 5


def arrays(count=COUNT, bodies=2):
    identity = np.zeros((count, bodies, 4))
    identity[..., 0] = 1.0
    return {
        "times": np.arange(count) * 0.1,
        "positions": np.arange(count * bodies * 3, dtype=float).reshape(count, bodies, 3),
        "orientations": identity,
        "velocities": -np.arange(count * bodies * 3, dtype=float).reshape(count, bodies, 3),
        "angular_velocities": np.zeros((count, bodies, 3)),
    }


def trajectory(**changes):
    return Trajectory(SCENARIO, SETTINGS, "toy", **arrays() | changes)


# Shapes


def test_a_body_has_its_own_column_of_the_arrays():
    made = trajectory()
    assert np.array_equal(made.position("ball"), arrays()["positions"][:, 1])
    assert np.array_equal(made.velocity("floor"), arrays()["velocities"][:, 0])
    with pytest.raises(UnknownName, match="unknown body 'box'"):
        made.position("box")


@pytest.mark.parametrize(
    ("name", "wrong", "expected"),
    [
        ("times", (COUNT, 1), (COUNT,)),
        ("positions", (COUNT, 3), (COUNT, 2, 3)),
        ("positions", (COUNT, 1, 3), (COUNT, 2, 3)),
        ("positions", (COUNT - 1, 2, 3), (COUNT, 2, 3)),
        ("orientations", (COUNT, 2, 3), (COUNT, 2, 4)),
        ("velocities", (COUNT, 2, 2), (COUNT, 2, 3)),
        ("angular_velocities", (COUNT, 2, 4), (COUNT, 2, 3)),
    ],
)
def test_an_array_of_the_wrong_shape_is_a_failed_run(name, wrong, expected):
    with pytest.raises(RunFailed) as caught:
        trajectory(**{name: np.ones(wrong)})
    assert str(caught.value) == f"toy: {name} has shape {wrong}; expected {expected}"


@pytest.mark.parametrize("count", [0, 1])
def test_a_trajectory_has_at_least_two_samples(count):
    with pytest.raises(RunFailed, match=f"toy: a trajectory needs two or more samples; it has {count}"):
        Trajectory(SCENARIO, SETTINGS, "toy", **arrays(count))


def test_a_trajectory_without_contacts_has_an_empty_table_of_them():
    made = Trajectory(SCENARIO, SETTINGS, "toy", **arrays(2))
    assert len(made.times) == 2
    shapes = {name: values.shape for name, values in vars(made.contacts).items()}
    rows = dict.fromkeys(("sample", "body_a", "body_b", "separation"), (0,))
    assert shapes == rows | {"position": (0, 3), "normal": (0, 3)}


@pytest.mark.parametrize("times", [[0.0, 0.1, 0.1, 0.2, 0.3], [0.0, 0.1, 0.3, 0.2, 0.4]], ids=["stands", "runs back"])
def test_time_goes_forward_from_sample_to_sample(times):
    with pytest.raises(RunFailed, match="toy: the times of a trajectory must increase"):
        trajectory(times=np.array(times))


# Non-finite states


@pytest.mark.parametrize("name", ["positions", "orientations", "velocities", "angular_velocities"])
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_failed_run_reports_when_its_state_stopped_being_finite(name, value):
    values = arrays()[name]
    values[3, 1, 2] = value
    with pytest.raises(RunFailed) as caught:
        trajectory(**{name: values})
    assert str(caught.value) == f"toy: {name} are not finite from t = 0.3 s on"


def test_a_run_that_was_never_finite_failed_at_the_start():
    with pytest.raises(RunFailed, match="positions are not finite from t = 0 s on"):
        trajectory(positions=np.full((COUNT, 2, 3), math.nan))


def test_a_time_that_is_not_finite_is_a_failed_run():
    with pytest.raises(RunFailed, match="toy: times are not finite"):
        trajectory(times=np.array([0.0, 0.1, 0.2, 0.3, math.inf]))


# Read-only


COPIES = pytest.mark.parametrize("copy", [lambda made: made, lambda made: pickle.loads(pickle.dumps(made))])


@COPIES
@pytest.mark.parametrize("name", list(arrays()))
def test_a_trajectory_cannot_be_changed_even_after_pickling(name, copy):
    made = copy(trajectory())
    with pytest.raises(ValueError, match="read-only"):
        getattr(made, name)[0] = 7.0
    with pytest.raises(FrozenInstanceError):
        setattr(made, name, arrays()[name])


@COPIES
@pytest.mark.parametrize("entry", fields(Contacts), ids=lambda entry: entry.name)
def test_contacts_of_a_trajectory_cannot_be_changed(entry, copy):
    contacts = copy(replace(trajectory(), contacts=recorded(contacts=[CONTACT]).contacts)).contacts
    values = getattr(contacts, entry.name)
    assert len(values) == 3
    with pytest.raises(ValueError, match="read-only"):
        values[0] = 7
    with pytest.raises(FrozenInstanceError):
        setattr(contacts, entry.name, values)


def test_a_trajectory_equals_only_itself():
    made, copy = trajectory(), trajectory()
    assert made == made
    assert made != copy
    assert made.contacts != copy.contacts
    assert len({made, copy}) == 2


def test_the_arrays_it_was_made_from_stay_writable():
    given = arrays()
    trajectory(**given)
    given["positions"][0] = 7.0
    assert given["positions"][0, 0, 0] == 7.0
    separation = np.array([-0.25])
    Contacts(separation=separation)
    separation[0] = 7.0


def test_lists_and_whole_numbers_become_arrays_of_floats():
    made = trajectory(times=[0, 1, 2, 3, 4], positions=np.ones((COUNT, 2, 3), dtype=int).tolist())
    assert made.times.dtype == made.positions.dtype == np.float64
    assert made.times.tolist() == [0, 1, 2, 3, 4]


def test_pickling_keeps_everything():
    contacts = Contacts(separation=np.array([-0.25]))
    made = replace(trajectory(), contacts=contacts, events=(Event(0.25, "impact", "ball"),))
    copy = pickle.loads(pickle.dumps(made))
    assert (copy.scenario, copy.settings, copy.engine, copy.events) == (SCENARIO, SETTINGS, "toy", made.events)
    assert all(np.array_equal(getattr(copy, name), getattr(made, name)) for name in arrays())
    assert copy.contacts.separation.tolist() == [-0.25]


# The recorder


def state(number):
    """26 numbers, each its own: what an engine hands over at a sample. Orientations are unit."""
    floor = [number, 1.0, 2.0, 1.0, 0.0, 0.0, 0.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]
    ball = [number, 11.0, 12.0, 0.5, 0.5, 0.5, 0.5, 13.0, 14.0, 15.0, 16.0, 17.0, 18.0]
    return floor + ball


CONTACT = (1, 0, (0.1, 0.2, 0.3), (0.0, 0.0, 1.0), -0.5)


def recorded(settings=SETTINGS, contacts=(), **options):
    recorder = Recorder("toy", SCENARIO, settings)
    for number in range(3):
        recorder.sample(state(number))
        for contact in contacts:
            recorder.contact(*contact)
    return recorder.trajectory(**options)


def test_a_recorder_splits_each_sample_into_its_four_parts():
    made = recorded()
    assert made.engine == "toy"
    assert made.position("ball").tolist() == [[0, 11, 12], [1, 11, 12], [2, 11, 12]]
    assert made.position("floor").tolist() == [[0, 1, 2], [1, 1, 2], [2, 1, 2]]
    assert made.orientations[1].tolist() == [[1, 0, 0, 0], [0.5, 0.5, 0.5, 0.5]]
    assert made.velocities[1].tolist() == [[3, 4, 5], [13, 14, 15]]
    assert made.angular_velocities[1].tolist() == [[6, 7, 8], [16, 17, 18]]
    assert len(made.contacts.sample) == 0


def test_samples_are_a_whole_number_of_steps_apart_in_time():
    assert recorded(Settings(0.25, sample_every=2)).times.tolist() == [0.0, 0.5, 1.0]


def test_a_spin_in_the_body_frame_is_turned_into_the_world_frame():
    made = recorded(spin_in_body_frame=True)
    # (½, ½, ½, ½) is a third of a turn about (1, 1, 1): x → y → z → x
    assert made.angular_velocities[1].tolist() == [[6, 7, 8], [18, 16, 17]]


def test_a_contact_belongs_to_the_latest_sample():
    contacts = [CONTACT, (0, 1, (0.4, 0.5, 0.6), (0.0, 1.0, 0.0), 0.25)]
    found = recorded(contacts=contacts).contacts
    assert found.sample.tolist() == [0, 0, 1, 1, 2, 2]
    assert found.body_a.tolist() == [1, 0] * 3
    assert found.body_b.tolist() == [0, 1] * 3
    assert found.position[:2].tolist() == [[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]]
    assert found.normal[:2].tolist() == [[0, 0, 1], [0, 1, 0]]
    assert found.separation[:2].tolist() == [-0.5, 0.25]
    assert found.sample.dtype == found.body_a.dtype == found.body_b.dtype == np.int64


def test_a_recorder_that_saw_nothing_makes_no_trajectory():
    with pytest.raises(RunFailed, match="needs two or more samples; it has 0"):
        Recorder("toy", SCENARIO, SETTINGS).trajectory()
