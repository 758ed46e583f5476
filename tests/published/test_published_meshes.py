"""Meshes of springs that other people computed, by hand, and what is behind the figures."""

from __future__ import annotations

import numpy as np
import pytest

from reference.engines.implementation import Implementation
from reference.published.by_hand import meshes
from reference.published.theirs import published


def elastic_catenary(case):
    """Pulls of an elastic cable on its ends, N, and where the ends of one with the given pulls are, m.

    The tension at the length s has the components H and w s − V, and the cable stretches by T/(EA) along it:
    x = H/w (asinh(V₁/H) − asinh(V₀/H)) + H L/(EA), z = (T₁ − T₀)/w + (w L²/2 − V L)/(EA).
    """
    along, up, length, stiffness, weight = case.values("along", "up", "length", "axial_stiffness", "weight")

    def ends(pulls):
        horizontal, vertical = pulls
        tension = np.array([-vertical, weight * length - vertical])
        x = horizontal / weight * np.diff(np.arcsinh(tension / horizontal))[0] + horizontal * length / stiffness
        z = np.diff(np.hypot(horizontal, tension))[0] / weight
        return x, z + (weight * length**2 / 2 - vertical * length) / stiffness

    pulls = printed = np.array([case.expected[name] for name in ("horizontal", "at_lower_end")])
    for _ in range(4):  # Newton, with differences of 1 N: from 2e-7 beside the root, two steps end in rounding
        slopes = np.stack([np.subtract(ends(pulls + d), ends(pulls - d)) / 2 for d in np.eye(2)], axis=-1)
        pulls = pulls - np.linalg.solve(slopes, np.subtract(ends(pulls), (along, up)))
    return np.array([*pulls, weight * length - pulls[1]]), np.subtract(ends(printed), (along, up))


@pytest.mark.statement(28, oracle="P35: MoorPy's elastic catenary")
@pytest.mark.slow
def test_a_chain_of_springs_pulls_at_its_ends_as_a_cable_does(as_published):
    found = np.ravel(list(as_published("P35").values()))
    theory, _ = elastic_catenary(published("P35"))
    # What the second extrapolation leaves is of sixth order; Newton's net force is 1e-10 of the weight
    assert found == pytest.approx(theory, abs=2e-4)


def test_the_published_cable_is_micrometres_away_from_its_ends():
    theory, away = elastic_catenary(published("P35"))
    assert away == pytest.approx([-5.0e-6, -1.8e-6], abs=1e-7)
    printed = np.array([published("P35").expected[name] for name in meshes.NAMES])
    assert np.max(np.abs(printed - theory)) == pytest.approx(5.9e-3, abs=1e-4)


@pytest.mark.slow  # the extrapolated pulls above are right only if the order is
def test_the_cable_in_springs_is_of_second_order_in_their_length():
    case, code = published("P35"), Implementation()
    coarse, middle, fine = (meshes._pulls(case, code, count) for count in meshes.SPRINGS)
    assert (coarse - middle) / (middle - fine) == pytest.approx([4, 4, 4], abs=0.02)


@pytest.mark.statement(28, oracle="P36: Calladine's count; Tibert and Pellegrino's twist")
def test_a_frame_with_bars_enough_is_shaky_in_two_shapes_alone(as_published):
    as_published("P36")
