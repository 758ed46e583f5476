"""What every whole report must hold, whether the engines ran or their recordings were read."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from reference.catalogue.case import Case
from reference.catalogue.family import Family
from reference.catalogue.scenarios import catalogue, passing_balls, pellets, spinning_rods, walls
from reference.comparison.verdicts import Row, Verdict
from reference.engines import engine_names, load_engine
from reference.engines.base import AT_STEP, Method
from reference.engines.profiles import EXACT, counts
from reference.sweeping_truth import unturned_balls, unturned_hands

Number = tuple[str, str, str, str, str]
"""Family, implementation, profile, case and quantity of one row."""


def _pellets_lost(case: Case, dt: float) -> float:
    """Share of the pellets that end no step overlapping the wall on their own side of its middle."""
    caught = case.parameters["thickness"] / 2 + pellets.RADIUS
    return max(0.0, 1 - caught / (case.parameters["speed"] * dt))


def _balls_lost(case: Case, dt: float) -> float:
    return unturned_balls(case.parameters["speed"] * dt, passing_balls.REACH)


def _rods_lost(case: Case, dt: float) -> float:
    return unturned_hands(case.parameters["spin"] * dt, spinning_rods.REACH, spinning_rods.DISTANCE)


LOST: dict[tuple[str, str], tuple[Callable[[Case, float], float], Callable[[float], bool]]] = {
    # A lost body is as wrong as it can be. The velocity kept is −e without loss and (1 + e) s − e with a share s
    # lost, and away by e or more where s is e/(1 + e) or more.
    ("pellets", "passed"): (_pellets_lost, lambda share: share > 0),
    ("pellets", "velocity_kept"): (
        _pellets_lost,
        lambda share: share >= pellets.RESTITUTION / (1 + pellets.RESTITUTION),
    ),
    ("spinning-rod", "passed"): (_rods_lost, lambda share: share > 0),
    # These balls meet at an offset, and slow ones lose some of those that graze. Half of them is no agreement.
    ("passing-balls", "passed"): (_balls_lost, lambda share: share >= passing_balls.MOST_LOST),
}
"""By family and quantity, which share of an ensemble a response at the ends of steps loses, and whether so large a
share is a disagreement with theory, in which none is lost. No case here is within two bodies of a border."""


def _disagrees(family: str, case: Case, quantity: str, method: Method, dt: float) -> bool:
    """Whether a method must give a number that is wrong by as much as the number itself."""
    if (family, quantity) in LOST and method.kind == AT_STEP:
        share, is_much = LOST[family, quantity]
        return is_much(share(case, dt))
    if (family, quantity) == ("two-walls", "speed_left"):  # the last of five impacts may be too slow to rebound
        return walls.SPEED * case.parameters["restitution"] ** (walls.IMPACTS - 1) < method.rest_speed
    return False


def _counted() -> Iterator[tuple[Family, Case, str, str]]:
    """Every family, case, implementation and profile that counts and in which a report has the case."""
    for family in catalogue().values():
        for name in engine_names():
            engine = load_engine(name)
            for profile in filter(counts, family.profiles(engine)):
                for case in family.cases_in(engine, profile):
                    yield family, case, name, profile


def expected_disagreements() -> set[Number]:
    """What disagrees with theory exactly as its method predicts: it looks at the ends of steps, or knows no rebound."""
    found = set()
    for family, case, name, profile in _counted():
        engine, scenario = load_engine(name), case.scenarios[0]
        settings = engine.settings(scenario, profile)
        method = engine.method(scenario, settings)
        found |= {
            (family.name, name, profile, case.name, quantity.name)
            for quantity in family.quantities
            if _disagrees(family.name, case, quantity.name, method, settings.timestep)
        }
    return found


NOT_PREDICTED = {
    "solid-edges": "rounding decides whether a ray along an edge meets the solid",
    "tipping-box": "no recurrence is written for a box that tips, and theory has no way that it goes",
}
"""Families whose numbers without theory are only shown, and why."""


def expected_silences() -> set[Number]:
    """What theory says nothing of and a recurrence predicts: all but costs, and what is exact by hand."""
    return {
        (family.name, name, profile, case.name, quantity.name)
        for family, case, name, profile in _counted()
        for quantity in family.quantities
        if quantity.theory(case) is None
        and not quantity.cost
        and family.name not in NOT_PREDICTED
        and profile != EXACT
        and (case.name, quantity.name) != ("head-on", "arrival")  # two who block each other's way never arrive
    }


def _numbers(rows: Sequence[Row], verdict: Verdict) -> list[Number]:
    return [
        (row.family, row.engine, row.profile, row.case, row.quantity)
        for row in rows
        if counts(row.profile) and row.verdict is verdict
    ]


def check_whole(rows: Sequence[Row]) -> None:
    """Every number that disagrees is one that must, and every number without theory is as predicted."""
    disagreeing = _numbers(rows, Verdict.DISAGREES)
    assert set(disagreeing) == expected_disagreements()
    assert len(disagreeing) == len(set(disagreeing))
    silent = _numbers([row for row in rows if row.expected is None], Verdict.PASS)
    assert set(silent) == expected_silences()
    assert len(silent) == len(set(silent))
