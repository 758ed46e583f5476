"""Where a difference from theory comes from: one setting is moved at a time, and the error measured again.

The error of the stock settings is what the defaults cost plus the error of the tuned ones. That in turn is split into
what goes away with the timestep, with a stiffer or firmer contact, with more work of the solver, and what remains.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from reference.compare import TUNED
from reference.engines.base import Engine
from reference.errors import CollisionsError, as_failed_run
from reference.family import Case, Family, Quantity
from reference.settings import Move, Option, Settings

STOCK = "stock"
ORDER_TOLERANCE = 0.2
"""How near to 2 a measured order must be to count as second order."""
DISCRETISATION, CONTACT_MODEL, SOLVER, DEFAULTS, REMAINDER = (
    "discretisation",
    "contact model",
    "solver",
    "defaults",
    "remainder",
)


@dataclass(frozen=True)
class Share:
    """What one move did to the mean error of a quantity, in its unit.

    kind: the share. moved: the setting, from what to what. before, after: the errors. size: how much of the error
    before is due to it, None where the run before had no number. Halving the timestep takes away half of an error of
    first order, so that twice the change is due to it.
    """

    kind: str
    moved: str
    before: float | None
    after: float
    size: float | None


@dataclass(frozen=True)
class Split:
    """The shares of one quantity's error in one case."""

    case: str
    quantity: str
    shares: tuple[Share, ...] = field(default=())


def split(family: Family, engine: Engine, order: float | None = None) -> Split | None:
    """Split the error of the quantity that the family studies; None where nothing can be run.

    order: the measured order of convergence. It counts where it is clearly 2; all else is taken for first order.
    """
    study = family.convergence
    case, quantity = family.case(study.case), family.quantity(study.quantity)
    scenario = case.scenarios[0]
    tuned = engine.settings(scenario, TUNED)
    error = _error(engine, case, quantity, tuned)
    if error is None:
        return None
    halving = 2 if order is not None and abs(order - 2) < ORDER_TOLERANCE else 1
    shares = _from_stock(engine, case, quantity, tuned)
    for move in (Move(DISCRETISATION, "timestep", tuned.timestep / 2), *engine.moves(scenario, tuned)):
        after = _error(engine, case, quantity, tuned.change(**{move.option: move.value}))
        if after is not None:
            # An error of order p keeps 2⁻ᵖ of itself with half the timestep.
            weight = 1 / (1 - 0.5**halving) if move.kind == DISCRETISATION else 1.0
            before = tuned.timestep if move.option == "timestep" else tuned[move.option]
            shares.append(
                Share(move.kind, _words(move.option, before, move.value), error, after, weight * (error - after))
            )
    known = sum(share.size for share in shares if share.kind != DEFAULTS and share.size is not None)
    shares.append(Share(REMAINDER, "what no move explains", error, error - known, error - known))
    return Split(case.name, quantity.name, tuple(shares))


def _from_stock(engine: Engine, case: Case, quantity: Quantity, tuned: Settings) -> list[Share]:
    """From the stock settings to the tuned ones, one option after another and the timestep last.

    Options that make sense only together are moved together.
    """
    settings = engine.settings(case.scenarios[0], STOCK)
    before, waiting, shares = _error(engine, case, quantity, settings), [], []
    for name, value in (*tuned.options.items(), ("timestep", tuned.timestep)):
        present = settings.timestep if name == "timestep" else settings.options.get(name)
        if present == value:
            continue
        waiting.append(_words(name, present, value))
        if name == "timestep":
            settings = replace(settings, timestep=tuned.timestep, sample_every=tuned.sample_every)
        else:
            settings = replace(settings, options={**settings.options, name: value})
        after = _error(engine, case, quantity, settings)
        if after is not None:
            size = None if before is None else before - after
            shares.append(Share(DEFAULTS, ", ".join(waiting), before, after, size))
            before, waiting = after, []
    return shares


def _error(engine: Engine, case: Case, quantity: Quantity, settings: Settings) -> float | None:
    """Mean error over the case's scenarios; None where the run gives no such number."""
    try:
        with as_failed_run():
            expected = quantity.expected_value(case, settings, engine.method(case.scenarios[0], settings))
            measured = [quantity.measure(trajectory) for trajectory in engine.run_many(case.scenarios, settings)]
            error = float(np.mean(measured)) - expected
    except CollisionsError:
        return None
    return error if math.isfinite(error) else None


def _words(option: str, before: Option | None, after: Option) -> str:
    return f"{option.replace('_', ' ')} {'unset' if before is None else _short(before)} → {_short(after)}"


def _short(value: Option) -> str:
    return f"{value:.3g}" if isinstance(value, float) else str(value)
