"""A ball in a bowl: what an implementation makes of a concave solid in the way of a ball, and how it rests on it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from catalogue_rows import job

from reference.catalogue.scenarios import bowls, catalogue
from reference.catalogue.scenarios.ball_in_a_bowl import DEEP, RADIUS
from reference.catalogue.scenarios.solids import Placed
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.errors import NotAsTold
from reference.scene import geometry
from reference.scene.scenario import Pair

CASE, FLOOR = f"depth={DEEP:g}", bowls.RIM - DEEP
SCENE = catalogue()["ball-in-a-bowl"].case(CASE).scenarios[0]
BLOCK = catalogue()["ball-in-a-bowl"].case("hull").scenarios[0]
TUNED = (("handwritten", "world"), ("pybullet", "tuned"), ("mujoco", "tuned"), ("dart", "tuned"))
NEAR = 1e-5
"""m: PyBullet's ball falls by g dt² where rounding decides that it does not touch."""


def rows(name, profile, case=CASE, **changes):
    return {row.quantity: row for row in job("ball-in-a-bowl", name, profile, case, **changes).rows}


@pytest.mark.parametrize(
    ("name", "profile"),
    [pytest.param(*each, marks=() if each[0] == "pybullet" else pytest.mark.slow) for each in TUNED],
)
@pytest.mark.slow
def test_a_ball_comes_to_rest_on_the_floor_and_leaves_a_wall_as_theory_says(name, profile, installed):
    installed(name)
    assert rows(name, profile)["rest"].measured == pytest.approx(FLOOR + RADIUS, abs=NEAR)
    aside = rows(name, profile, "wall")["aside"]
    assert aside.verdict is Verdict.PASS
    assert aside.off == pytest.approx(0.0, abs=1e-6)  # from what the method predicts, m/s


@pytest.mark.parametrize(("name", "margin"), [("pybullet", 1e-3), ("mujoco", 0.0)])
def test_as_installed_a_ball_rests_on_the_lid_of_the_bowls_hull(name, margin, installed):
    installed(name)
    found = rows(name, "stock")
    # Bullet's hull has a margin of 1 mm.
    assert found["rest"].measured == pytest.approx(bowls.RIM + RADIUS + margin, abs=1e-4)
    assert found["rest"].verdict is Verdict.DISAGREES
    on_the_block = rows(name, "stock", "hull")["rest"]
    assert on_the_block.measured == pytest.approx(found["rest"].measured, abs=1e-6)
    assert on_the_block.verdict is Verdict.PASS


@pytest.mark.parametrize(("name", "margin"), [("pybullet", 1e-3), ("mujoco", 0.0)])
def test_as_installed_a_contact_has_the_gap_to_the_block_that_is_the_hull(name, margin, installed):
    engine = installed(name)
    found = engine.run(SCENE, engine.settings(SCENE, "stock"))
    contacts = found.contacts
    block = replace(SCENE.body("solid"), shape=BLOCK.body("solid").shape)
    assert len(contacts.sample) > 50
    for sample, separation, normal in zip(contacts.sample, contacts.separation, contacts.normal, strict=True):
        ball = replace(SCENE.body("ball"), position=tuple(found.position("ball")[sample]))
        # A contact is found before its step moves the ball, which falls at up to 2 m/s.
        near = 2.1 * found.settings.timestep
        assert separation + margin == pytest.approx(geometry.gap(ball, block), abs=near)
        assert abs(normal[2]) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("name", ["pybullet", pytest.param("mujoco", marks=pytest.mark.slow)])
def test_the_hull_alone_brings_a_tuned_engine_to_the_lid_as_predicted(name, installed):
    installed(name)
    found = rows(name, "tuned", contacts_of="hull")
    assert [found[each].verdict for each in ("rest", "landing")] == [Verdict.DISAGREES] * 2
    assert found["rest"].off == pytest.approx(0.0, abs=NEAR)


@pytest.mark.parametrize("scene", [SCENE, BLOCK], ids=["bowl", "block"])
def test_darts_default_detector_lets_a_ball_fall_through_a_mesh(scene, installed):
    engine = installed("dart")
    stock = engine.run(scene, engine.settings(scene, "stock"))
    fall = scene.gravity[2] / 2 * float(stock.times[-1]) ** 2
    way = stock.position("ball")[-1] - stock.position("ball")[0]
    assert way == pytest.approx((0.0, 0.0, fall), abs=0.01)  # a step falls g t dt/2 too far
    depths = stock.contacts.separation[stock.contacts.separation > 0]
    assert len(depths), "it reports the contact, with a gap where there is an overlap"
    settings = engine.settings(scene, "tuned")
    assert settings["detector"] == "dart"
    held = engine.run(scene, settings)
    assert float(held.position("ball")[-1, 2]) > scene.body("solid").position[2]


@pytest.mark.parametrize(("name", "profile"), [pytest.param(*TUNED[0], marks=pytest.mark.slow), *TUNED[1:]])
def test_a_ball_that_slides_over_the_edge_within_the_floor_goes_straight_on(name, profile, installed):
    engine, place = installed(name), Placed(SCENE.body("solid"))
    start, way = np.array([-0.4, 0.1, FLOOR + RADIUS]), np.array([1.0, -0.3, 0.0])
    ball = replace(SCENE.body("ball"), position=place.at(start), velocity=place.along(way))
    scene = replace(SCENE, bodies=(place.body, ball), pairs=(Pair("ball", "solid"),), duration=0.6)
    found = engine.run(scene, engine.settings(scene, profile))
    off = np.abs(found.velocity("ball")[:, :2] - np.array(ball.velocity)[:2]).max()
    # Of two triangles that share an edge, PyBullet pushes along the way to each. MuJoCo has a least friction of 10⁻⁵.
    assert off < {"pybullet": 1e-3, "mujoco": 1e-4}.get(name, 1e-12)
    assert (off > 1e-5) == (name in ("pybullet", "mujoco"))


def test_a_piece_without_its_contact_pair_is_refused(installed, monkeypatch):
    engine = installed("mujoco")
    spec = engine.module().MjSpec
    real = spec.add_pair

    def all_but_the_floor(self, **told):
        return None if "solid 0" in told.values() else real(self, **told)

    monkeypatch.setattr(spec, "add_pair", all_but_the_floor)
    with pytest.raises(NotAsTold, match="says contact pairs of ball and solid 4, and was told 5"):
        engine.run(SCENE, engine.settings(SCENE, "tuned"))


def test_the_world_is_told_the_convex_pieces_with_their_flat_faces():
    engine = load_engine("handwritten")
    assert list(engine.profiles(SCENE)) == ["world"]
    run = engine.run(replace(SCENE, duration=0.4), engine.settings(SCENE, "world"))
    assert run.contacts.normal == pytest.approx(np.tile((0.0, 0.0, 1.0), (len(run.contacts.sample), 1)), abs=1e-12)
