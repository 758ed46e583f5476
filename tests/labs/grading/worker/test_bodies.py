"""Bodies keep the names that the notebook's own `Body` gives them."""

from __future__ import annotations

import numpy as np

from labs.grading.worker.bodies import Body, with_names
from solutions.impulse.body import Body as InTheNotebook


def test_a_body_has_the_names_of_the_notebook_and_is_still_a_tuple():
    assert Body._fields == InTheNotebook._fields
    found = with_names((np.ones(3), np.zeros(3), np.ones(3), 0.5, np.eye(3)))
    assert isinstance(found, tuple)
    assert found.inverse_mass == found[3] == 0.5


def test_other_arguments_stay_as_they_are():
    vector, pair = np.ones(5), (1.0, 2.0)
    contacts = (np.ones(1), np.zeros(1), np.ones((1, 3)), np.ones((1, 3)), np.zeros(1), np.ones(1))
    assert with_names(vector) is vector
    assert with_names(pair) is pair
    assert with_names(contacts) is contacts
