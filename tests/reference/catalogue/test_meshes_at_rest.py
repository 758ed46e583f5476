"""Chains, cloth and jelly at rest: which motions their springs resist, and that each has one shape."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference import drape_truth, mesh_truth
from reference.catalogue.scenarios import catalogue, settled
from reference.catalogue.scenarios.jelly import PUSH, TOP
from reference.scene.forces import Force
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.spring_network import network
from reference.scene.trajectory import Trajectory

EDGES, FACES = (case.scenarios[0] for case in catalogue()["jelly"].cases)


def free_stiffness(scenario: Scenario) -> tuple[np.ndarray, np.ndarray]:
    """The stiffness matrix of the free nodes in the shape at the start, N/m, and their numbers."""
    net = network(scenario)
    rows = (3 * net.free[:, None] + np.arange(3)).ravel()
    matrix = mesh_truth.stiffness_matrix(net.place, net.edges, net.stiffness, net.rest_length)
    return matrix[np.ix_(rows, rows)], net.free


@pytest.mark.parametrize(("scenario", "motions"), [(EDGES, 8), (FACES, 0)], ids=["edges", "faces"])
def test_edges_alone_leave_eight_motions_that_stretch_no_spring(scenario, motions):
    values = np.linalg.eigvalsh(free_stiffness(scenario)[0])
    assert np.sum(values < 1e-9 * values[-1]) == motions


def test_a_light_jelly_leans_by_the_inverse_of_its_stiffness():
    pushes = tuple(Force(FACES.bodies[number].name, tuple((1e-3 * PUSH).tolist())) for number in TOP)
    light = replace(FACES, gravity=(0.0, 0.0, 0.0), forces=pushes)
    matrix, free = free_stiffness(light)
    linear, load = np.zeros((len(light.bodies), 3)), np.zeros((len(light.bodies), 3))
    load[TOP] = 1e-3 * PUSH
    linear[free] = np.linalg.solve(matrix, load[free].ravel()).reshape(-1, 3)
    start = np.array([body.position for body in light.bodies])
    # The next order is the strain, 5·10⁻⁵ m over 3 cm, times some ten.
    np.testing.assert_allclose(settled.at_rest(light) - start, linear, atol=0.02 * np.abs(linear).max())


def test_how_far_a_mesh_is_off_is_said_of_its_farthest_node():
    states = np.array([body.state() for body in FACES.bodies])
    place, turn, velocity, spin = np.split(np.stack([states, states]), (3, 7, 10), axis=-1)
    place[1] = settled.at_rest(FACES)
    free = network(FACES).free
    place[1, free[0]] += (0.003, 0.0, -0.004)
    place[1, free[-1]] += (0.0, 0.001, 0.0)
    made = Trajectory(FACES, Settings(1e-3), "made up", np.array([0.0, FACES.duration]), place, turn, velocity, spin)
    assert settled.off(made) == pytest.approx(0.005)


@pytest.mark.parametrize("name", ["hanging-chain", "hanging-cloth", "jelly"])
def test_a_mesh_has_one_shape_at_rest_from_wherever_it_comes(name):
    drawn = np.random.default_rng(28)
    for case in catalogue()[name].cases:
        scenario = case.scenarios[0]
        net, shape = network(scenario), settled.at_rest(scenario)
        told = net.free, net.edges, net.stiffness, net.rest_length
        assert mesh_truth.softest(shape, *told) > 1, "N/m: it is stable"
        aside = shape.copy()
        aside[net.free] += drawn.normal(scale=5e-3, size=(len(net.free), 3))
        np.testing.assert_allclose(mesh_truth.equilibrium(aside, *told, net.load), shape, atol=1e-9)


def test_a_drape_has_one_shape_at_rest_from_wherever_it_comes():
    drawn = np.random.default_rng(28)
    family = catalogue()["cloth-over-a-ball"]
    for case in (*family.cases, *(family.grid.case(radius=radius) for radius in (0.025, 0.0275))):
        scenario = case.scenarios[0]
        net, shape, ball = network(scenario), settled.at_rest(scenario), settled.ball_of(scenario)
        told = net.free, net.edges, net.stiffness, net.rest_length, net.load, ball
        assert drape_truth.softest(shape, *told) > 1, "N/m: it is stable"
        aside = shape.copy()
        aside[net.free] += drawn.normal(scale=5e-3, size=(len(net.free), 3))
        np.testing.assert_allclose(drape_truth.draped(aside, *told), shape, atol=1e-9)
