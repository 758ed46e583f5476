"""Fits of a sphere's drag against the package fluids, and the factors of walls against exact published values."""

from __future__ import annotations

import functools
import warnings

import numpy as np
import pytest
from oracles import oracle

from solutions.forces import (
    CORRELATIONS,
    DragRangeWarning,
    StokesRegimeWarning,
    drag_correction,
    parallel_wall_factor,
    perpendicular_wall_factor,
    terminal_velocity,
    terminal_velocity_corrected,
    tube_wall_factor,
)

DOWN = np.array([0.0, 0.0, -9.81])


def terminal_velocity_without_warning(radius, *sphere):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", StokesRegimeWarning)
        return terminal_velocity(radius, *sphere)[2]


# Fits by name


@pytest.mark.statement(26, oracle="fluids: twelve correlations by their names")
@pytest.mark.parametrize("name", sorted(set(CORRELATIONS) - {"Clift", "Schiller_Naumann"}))
def test_a_fit_with_a_name_of_the_package_fluids_has_its_values(name):
    drag, fit = oracle("fluids.drag"), CORRELATIONS[name]
    reynolds = np.geomspace(max(fit.least, 1e-3), fit.most, 60)
    theirs = np.array([getattr(drag, name)(re) * re / 24 for re in reynolds])
    assert drag_correction(reynolds, name) == pytest.approx(theirs, rel=1e-12, abs=0)
    least, most = drag.drag_sphere_correlations[name][1:]
    assert fit.most == most
    assert fit.least == least or (least is None and fit.least <= 0.01)  # where the package names no end


@pytest.mark.statement(26, oracle="Clift, Grace and Weber: Schiller and Naumann are within 5 % up to Re = 800")
def test_schiller_and_naumann_are_near_the_fit_of_the_same_experiments():
    reynolds = np.geomspace(0.01, 800, 200)
    ratio = drag_correction(reynolds, "Schiller_Naumann") / drag_correction(reynolds)
    assert np.all(np.abs(ratio - 1) < 0.053)
    assert drag_correction(1.0, "Schiller_Naumann") == 1.15
    assert CORRELATIONS["Clift"].coefficient(np.array([50.0])) * 50 / 24 == drag_correction(50.0)


def test_a_fit_outside_its_range_warns_and_names_both():
    with pytest.warns(DragRangeWarning, match=r"^Stokes is for Re from 0 to 0\.3; here Re is 2$"):
        assert drag_correction([0.1, 2.0, 0.5], "Stokes").tolist() == [1, 1, 1]
    with pytest.warns(DragRangeWarning, match=r"^Terfous is for Re from 0\.1 to 50000; here Re is 0\.05$"):
        drag_correction([0.05, 1.0], "Terfous")
    for name, fit in CORRELATIONS.items():  # any warning is an error here
        assert drag_correction([0.0, max(fit.least, 1e-3), fit.most], name)[0] == 1
        assert fit.source
    with pytest.raises(ValueError, match=r"^correlation must be one of Stokes, .*, not 'Oseen'$"):
        drag_correction(1.0, "Oseen")


@pytest.mark.statement(26, oracle="fluids: v_terminal by other correlations")
def test_a_fall_takes_any_fit_and_warns_only_of_its_own_speed():
    fluids = oracle("fluids")
    for name in ("Haider_Levenspiel", "Terfous"):
        fit = functools.partial(drag_correction, correlation=name)
        theirs = fluids.v_terminal(D=1e-3, rhop=2600.0, rho=1000.0, mu=1e-3, Method=name)
        # Terfous has no values below Re = 0.1, which the search passes on its way to 150
        ours = terminal_velocity_corrected(5e-4, 2600.0, 1000.0, 1e-3, (0, -9.80665, 0), fit)
        assert ours[1] == pytest.approx(-theirs, rel=1e-9, abs=0)
    fit = functools.partial(drag_correction, correlation="Terfous")
    sphere = (2600.0, 1000.0, 1e-3, DOWN)
    # At Re = 0.15 its drag is about 1 % below Stokes', and so the fall is faster
    excess = terminal_velocity_corrected(2.78e-5, *sphere, fit)[2] / terminal_velocity_without_warning(2.78e-5, *sphere)
    assert 1 < excess < 1.02
    with pytest.warns(DragRangeWarning, match=r"here Re is 0\.00"):
        terminal_velocity_corrected(1e-5, *sphere, fit)


# Walls near by


@pytest.mark.statement(26, oracle="Haberman and Sayre 1958: exact values for a sphere in a tube")
def test_the_wall_of_a_tube_raises_the_drag_as_haberman_and_sayre_found():
    exact = np.array([1.263, 1.680, 2.371])  # at r/R of 0.1, 0.2 and 0.3
    assert tube_wall_factor([0.1, 0.2, 0.3], 1.0) == pytest.approx(exact, rel=2.6e-3, abs=0)
    with pytest.warns(DragRangeWarning, match=r"here r/R is 0\.5$"):
        assert tube_wall_factor(1.0, 2.0) == pytest.approx(5.970 * (1 - 0.065), rel=1e-3)
    assert tube_wall_factor(1e-6, 1.0) == pytest.approx(1 + 2.10444e-6, rel=1e-11)
    with pytest.raises(ValueError, match=r"^tube_radius must be above the radius"):
        tube_wall_factor(1.0, 1.0)


@pytest.mark.statement(26, oracle="Goldman, Cox and Brenner 1967: exact values along a wall")
def test_along_a_plane_wall_faxens_factor_is_near_the_exact_one():
    distance, exact = [10.0677, 3.7622, 2.3524, 1.5431], [1.0591, 1.1738, 1.3079, 1.5675]
    factor = parallel_wall_factor(0.2, 0.2 * np.array(distance))
    assert factor[:3] == pytest.approx(exact[:3], rel=1e-3, abs=0)
    assert factor[3] == pytest.approx(exact[3], rel=0.0106, abs=0)
    with pytest.warns(DragRangeWarning, match=r"here h/r is 1\.128$"):
        assert parallel_wall_factor([1.0, 1.0], [2.0, 1.1276])[1] == pytest.approx(2.1514 * 1.044, rel=1e-3, abs=0)
    with pytest.raises(ValueError, match=r"^distance must be above the radius"):
        parallel_wall_factor(1.0, 1.0)


@pytest.mark.statement(26, oracle="Brenner's exact series of 1961, and the lubrication of a thin gap")
def test_towards_a_wall_the_factor_is_brenners_series_at_any_distance():
    alpha, n = np.geomspace(0.03, 5, 40), np.arange(1, 800)[:, None]
    small = np.exp(-(2 * n + 1) * alpha)  # divides both sinh of the quotient, so that neither overflows
    quotient = (1 - small**2 + (2 * n + 1) * np.sinh(2 * alpha) * small) / (
        (1 - small) ** 2 - (2 * n + 1) ** 2 * np.sinh(alpha) ** 2 * small
    )
    exact = 4 / 3 * np.sinh(alpha) * np.sum(n * (n + 1) / ((2 * n - 1) * (2 * n + 3)) * (quotient - 1), axis=0)
    factor = perpendicular_wall_factor(3.0, 3.0 * np.cosh(alpha))
    assert factor == pytest.approx(exact, rel=7.1e-3, abs=0)
    assert perpendicular_wall_factor(1e-300, [1, 1e300]).tolist() == [1, 1]  # in a fluid without end
    assert perpendicular_wall_factor(1.0, 1 + 1e-9) * 1e-9 == pytest.approx(1, rel=1e-6)
    with pytest.raises(ValueError, match=r"^distance must be above the radius"):
        perpendicular_wall_factor(2.0, 1.0)
