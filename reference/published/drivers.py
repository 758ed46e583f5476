"""Which function answers which published case, by hand and in the engines, or why no function does."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from reference.engines.base import Engine
from reference.engines.implementation import Implementation
from reference.errors import CannotExpress, NoWords
from reference.published.answers import Answers
from reference.published.by_hand import (
    avoidance,
    bounces,
    detection,
    forces,
    friction,
    impulse,
    meshes,
    polyhedra,
    sliding,
    springs,
    sweeping,
    world,
)
from reference.published.case import Published
from reference.published.in_engines import bouncing, leaning, loaded, plate, questions, rolling, striking, touching
from reference.published.in_engines import sliding as sliding_in_engines
from reference.published.in_engines import springs as springs_in_engines

HANDWRITTEN = "handwritten"
"""The engine that runs the functions of an implementation."""
STEERS = "no engine steers; it moves what is steered"
NOT_SET_UP = "the lab has not set it up there"
NO_REST = "a cable of stiff springs swings for minutes, in steps of milliseconds, before its pulls are those at rest"
NO_SPRINGS = {"dart": "its contacts have no spring and no dashpot that one could set"}


@dataclass(frozen=True)
class Drivers:
    """How one case is answered.

    by_hand: by an implementation's functions. in_engines: by an engine that runs it. lacking: what the lab cannot say
    yet, so that no engine runs it. why_not: why no engine could run it. why_not_in: the same of single engines, by
    name.
    """

    by_hand: Callable[[Published, Implementation], Answers] | None = None
    in_engines: Callable[[Published, Engine], Answers] | None = None
    lacking: str = NOT_SET_UP
    why_not: str = ""
    why_not_in: Mapping[str, str] = field(default_factory=dict)


DRIVERS = {
    "P1": Drivers(bounces.elastic_balls, bouncing.elastic_balls),
    "P2": Drivers(sliding.box_under_balls, plate.plate),
    "P3": Drivers(springs.spring_and_dashpot, springs_in_engines.spring_and_dashpot, why_not_in=NO_SPRINGS),
    "P4": Drivers(friction.begins_to_roll, rolling.set_sliding),
    "P5": Drivers(bounces.apexes, bouncing.apexes),
    "P6": Drivers(bounces.first_rebound, bouncing.first_rebounds),
    "P7": Drivers(sliding.stopping, sliding_in_engines.stopping_box),
    "P8": Drivers(sliding.stopping, sliding_in_engines.stopping_box),
    "P9": Drivers(springs.rest_depths, springs_in_engines.rest_depths, why_not_in=NO_SPRINGS),
    "P10": Drivers(sliding.ramp, sliding_in_engines.ramp),
    "P11": Drivers(friction.oblique_impacts, striking.oblique_impacts),
    "P12": Drivers(bounces.thousand_steps, bouncing.thousand_steps),
    "P13": Drivers(friction.rolls_down, rolling.down_a_slope),
    "P14": Drivers(forces.free_flight, sliding_in_engines.free_flight),
    "P15": Drivers(bounces.impacts_and_rest, bouncing.impacts_and_rest),
    "P16": Drivers(forces.dry_oscillator, loaded.dry_oscillator),
    "P17": Drivers(friction.spinning_ball, rolling.spinning_ball),
    "P18": Drivers(springs.undamped_spring, springs_in_engines.undamped_spring, why_not_in=NO_SPRINGS),
    "P19": Drivers(sweeping.box2d, questions.rays_and_distance),
    "P20": Drivers(forces.glycerol, loaded.glycerol),
    "P21": Drivers(impulse.textbook_bounce, striking.textbook_bounce),
    "P22": Drivers(impulse.elastic_bounce, striking.textbook_bounce),
    "P23": Drivers(avoidance.half_plane, why_not=STEERS),
    "P24": Drivers(polyhedra.neighbouring_points, why_not="no engine says on which side of a line a point lies"),
    "P25": Drivers(forces.sand_grain, loaded.sand_grain),
    "P26": Drivers(bounces.rebounds, bouncing.measured_rebounds),
    "P27": Drivers(impulse.colliding_pair, striking.colliding_pair),
    "P28": Drivers(detection.hot_rock, bouncing.hot_rock),
    "P29": Drivers(detection.box_below_plane, touching.box_below_plane),
    "P30": Drivers(sweeping.ball_and_cube, touching.ball_and_cube),
    "P31": Drivers(sweeping.primitives, touching.swept_ball),
    "P32": Drivers(avoidance.lines_of_the_port, why_not=STEERS),
    "P33": Drivers(avoidance.permitted, why_not=STEERS),
    "P34": Drivers(polyhedra.star_polyhedra, why_not="no engine counts how often a surface winds round a point"),
    "P35": Drivers(meshes.cable, lacking=NO_REST),
    "P36": Drivers(meshes.shaky_frames, why_not="no engine counts the motions of a frame that cost no energy"),
    "P37": Drivers(world.three_discs, striking.three_discs),
    "P38": Drivers(world.handbook, why_not="no engine solves a complementarity problem that it is handed"),
    "P39": Drivers(forces.three_bodies, loaded.three_bodies),
    "P40": Drivers(forces.block_on_spring, loaded.block_on_spring),
    "P41": Drivers(world.ladder, leaning.ladder),
}


def answers_of(case: Published, engine: Engine) -> Answers:
    """What an engine answers to a published case, the hand-written one by its implementation's functions.

    Raises
    ------
    CannotExpress
        If the engine cannot run the case; the message says why.
    NoWords
        If the lab cannot say it to an engine yet.
    NeedsFunction
        If the implementation lacks a function.
    """
    drivers = DRIVERS.get(case.name, Drivers())
    if why := drivers.why_not_in.get(engine.name):
        raise CannotExpress(why)
    if engine.name == HANDWRITTEN:
        if drivers.by_hand is None:
            raise NoWords(NOT_SET_UP)
        return drivers.by_hand(case, engine.implementation)
    if drivers.in_engines is None and drivers.why_not:
        raise CannotExpress(drivers.why_not)
    if drivers.in_engines is None:
        raise NoWords(drivers.lacking)
    engine.module()
    return drivers.in_engines(case, engine)
