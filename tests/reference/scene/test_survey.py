"""Polyhedra and surveys: what is refused, and that a survey's bodies are what its questions are about."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.errors import InvalidInput, UnknownName
from reference.scene import geometry
from reference.scene.polyhedron import Polyhedron
from reference.scene.query import Distance, Inside, Segment
from reference.scene.scenario import Body, Box, Pair, Sphere
from reference.scene.survey import at_time, survey

CORNERS = ((0, 0, 0), (2, 0, 0), (0, 3, 0), (0, 0, 4))
FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
SOLID = Body("solid", Polyhedron(CORNERS, FACES), position=(1, 0, 0))
BALL = Body("ball", Sphere(0.1), 2.0, (5, 0, 0), velocity=(-1, 2, 0))
ASKED = survey("asked", [("in", Inside(SOLID, (1.2, 0.1, 0.1)))], [Distance(SOLID, BALL)])


def test_the_volume_of_a_tetrahedron_is_a_sixth_of_its_edges_product():
    assert SOLID.shape.volume == pytest.approx(2 * 3 * 4 / 6)
    assert SOLID.shape.convex_pieces == ((0, 1, 2, 3),)


@pytest.mark.parametrize(
    ("faces", "pieces", "words"),
    [
        (FACES[:3], (), "must close"),
        ((*FACES[:3], (1, 3, 2)), (), "look one way"),
        (tuple((a, c, b) for a, b, c in FACES), (), "look outwards"),
        ((*FACES[:3], (1, 2, 4)), (), "different ones of 4 vertices"),
        (FACES, ((0, 1, 2),), "different ones of 4 vertices"),
        ((), (), "must close"),
        ((*FACES[:3], (1, 2, 3.0)), (), "whole numbers of vertices"),
        (("021", *FACES[1:]), (), "has '021'; it takes whole numbers of vertices"),
        ((1, 2, 3, 0), (), r"faces\[0\] is 1"),
    ],
)
def test_a_surface_that_encloses_nothing_is_refused(faces, pieces, words):
    with pytest.raises(InvalidInput, match=words):
        Polyhedron(CORNERS, faces, pieces)


def test_a_dented_solid_is_refused_where_no_pieces_say_how_it_is_dented():
    # The face opposite the origin gets a vertex in its middle, pushed in or out by some millimetres
    inner = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 4), (2, 3, 4), (3, 1, 4)]
    middle = np.mean(CORNERS[1:], axis=0)
    dented = (*CORNERS, tuple((middle - 0.003).tolist()))
    with pytest.raises(InvalidInput, match=r"without pieces must be convex; vertex \d is in front of face"):
        Polyhedron(dented, inner)
    assert Polyhedron(dented, inner, ((0, 1, 2, 4), (0, 2, 3, 4), (0, 3, 1, 4))).volume < 4
    assert Polyhedron((*CORNERS, tuple((middle + 0.003).tolist())), inner).volume > 4
    assert Polyhedron((*CORNERS, tuple(middle.tolist())), np.array(inner)).volume == pytest.approx(4)


def test_two_bodies_of_one_name_are_refused_in_a_survey():
    larger = replace(SOLID, position=(2, 0, 0))
    with pytest.raises(InvalidInput, match="two bodies that it asks about share the name 'solid'"):
        survey("asked", [("in", Inside(SOLID, (1.2, 0.1, 0.1))), ("out", Inside(larger, (0, 0, 0)))])


def test_a_polyhedron_that_could_move_is_refused_and_so_is_its_gap():
    with pytest.raises(InvalidInput, match="a polyhedron has mass 1"):
        replace(SOLID, mass=1.0)
    with pytest.raises(InvalidInput, match="solid is a mesh"):
        geometry.gap(replace(BALL, shape=Box((1, 1, 1))), SOLID)


def test_a_question_is_about_the_body_that_the_survey_has():
    moved = replace(ASKED, bodies=(replace(SOLID, position=(9, 9, 9)), BALL))
    assert dict(moved.questions)["in"].body.position == (9, 9, 9)
    assert moved.watched[0].body_a.position == (9, 9, 9)
    with pytest.raises(UnknownName, match="ball"):
        replace(ASKED, bodies=(SOLID,))


def test_a_survey_in_which_something_would_happen_is_refused():
    pull, twice = {"gravity": (0, 0, -9.81)}, {"questions": ASKED.questions * 2}
    for change in ({"pairs": (Pair("ball", "solid"),)}, pull, twice):
        with pytest.raises(InvalidInput, match=r"in a survey nothing|needs a name of its own"):
            replace(ASKED, **change)
    with pytest.raises(InvalidInput, match="needs a length"):
        Segment(SOLID, (1, 2, 3), (1, 2, 3))


def test_a_question_has_a_place_and_an_unknown_one_is_refused():
    assert ASKED.place("in") == 0
    with pytest.raises(UnknownName, match="question"):
        ASKED.place("out")


def test_a_body_of_a_survey_flies_straight():
    assert at_time(BALL, 0.5).position == (4.5, 1.0, 0.0)
