"""A film of a world that a notebook makes of plain arrays."""

from __future__ import annotations

import json
import re
from html import unescape

import numpy as np

from labs.desk.own_world import BALL, FLOOR, film, thing, world


def test_a_film_from_above_shows_a_ball_wherever_it_comes():
    bodies, state = world([FLOOR, thing(BALL, 0.1, 1.0, (0, 0, 2))])
    places = [np.array([[0, 0, 0], [0.3 * k, 0, max(0.1, 2 - 0.5 * k)]]) for k in range(6)]
    shown = film(bodies, [(place, *state[1:]) for place in places], 0.1, oblique=True).markup
    low, high = (
        json.loads(re.search(rf'"{end}":(\[[^]]*\])', unescape(unescape(shown)))[1]) for end in ("low", "high")
    )
    reach = np.array([place[1] for place in places])
    assert np.all(np.array(low) <= reach.min(axis=0) - 0.1 + 1e-5)  # bounds are rounded to 10 µm
    assert np.all(np.array(high) >= reach.max(axis=0) + 0.1 - 1e-5)
