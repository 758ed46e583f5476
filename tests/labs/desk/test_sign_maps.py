"""Maps of signs in a notebook: how many are wrong is said in words as well."""

from __future__ import annotations

import numpy as np
import pytest

from labs.desk.sign_maps import sign_maps
from reference.errors import InvalidInput

RIGHT = np.array([[1, 0, -1], [1, 1, 0]])


def test_map_says_how_many_signs_are_wrong():
    picture = sign_maps({"first": RIGHT, "second": np.zeros_like(RIGHT)}, RIGHT)
    assert picture.png.startswith(b"\x89PNG")
    assert picture.text == "[signs: first: 0 of 6 wrong; second: 4 of 6 wrong]"


def test_signs_that_fit_no_grid_are_named():
    with pytest.raises(InvalidInput, match=r"first: signs of the shape \(6,\)"):
        sign_maps({"first": RIGHT.ravel()}, RIGHT)
    with pytest.raises(InvalidInput, match="at least one"):
        sign_maps({}, RIGHT)
