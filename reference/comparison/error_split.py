"""Where a difference from theory comes from: one setting is moved at a time, and the error is measured again.

The error of the stock settings is the error of the tuned ones plus what the defaults cost. The tuned error is split
into the shares that vanish with a shorter timestep, with a stiffer or firmer contact and with more work of the solver,
and a remainder.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from reference.comparison.errors_by_settings import Question
from reference.engines.base import Engine
from reference.engines.profiles import PLAIN_OF, counts
from reference.errors import InvalidInput, RunFailed
from reference.scene.settings import Move, Option, Settings

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

    kind: the cause that the move shows, one of the five above. moved: the setting, with its values before and after.
    before, after: the errors. size: how much of the error before is due to the cause, None where the run before had no
    number. Halving the timestep takes away half of an error of first order, so that twice the change is due to it.
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


def split(asked: Question, order: float | None = None) -> Split | None:
    """Split the error of the studied quantity; None where the tuned run gives no number.

    order: the measured order of convergence. The timestep's share is worked out for second order where it is clearly 2,
    and for first order otherwise.
    """
    engine, scenario = asked.engine, asked.case.scenarios[0]
    profile = next(filter(counts, engine.profiles(scenario)))
    tuned = engine.settings(scenario, profile)
    error = asked.mean_error(tuned)
    if error is None:
        return None
    power = 2 if order is not None and abs(order - 2) < ORDER_TOLERANCE else 1
    plain = PLAIN_OF.get(profile, "")
    shares = _from_stock(asked, tuned, plain) if plain in engine.profiles(scenario) else []
    for move in (Move(DISCRETISATION, "timestep", tuned.timestep / 2), *engine.moves(scenario, tuned)):
        after = asked.mean_error(_moved(engine, tuned, move))
        if after is not None:
            # With half the timestep, 2⁻ᵖ of an error of order p is left.
            weight = 1 / (1 - 0.5**power) if move.kind == DISCRETISATION else 1.0
            before = tuned.timestep if move.option == "timestep" else tuned[move.option]
            shares.append(
                Share(move.kind, _words(move.option, before, move.value), error, after, weight * (error - after))
            )
    known = sum(share.size for share in shares if share.kind != DEFAULTS and share.size is not None)
    shares.append(Share(REMAINDER, "what no move explains", error, error - known, error - known))
    return Split(asked.case.name, asked.quantity.name, tuple(shares))


def _moved(engine: Engine, tuned: Settings, move: Move) -> Settings:
    try:
        return tuned.change(**{move.option: move.value})
    except InvalidInput as error:
        raise RunFailed(f"{engine.title} names a move that its settings do not allow: {error}") from None


def _from_stock(asked: Question, tuned: Settings, plain: str) -> list[Share]:
    """From the plain settings to the tuned ones, one option after another and the timestep last.

    A share covers several options where only all of them together give a number.
    """
    scenario = asked.case.scenarios[0]
    settings = asked.engine.settings(scenario, plain)
    before, waiting, shares = asked.mean_error(settings), [], []
    names = (*tuned.options, *(name for name in settings.options if name not in tuned.options), "timestep")
    present: Option | None
    value: Option | None
    for name in names:
        if name == "timestep":
            present, value = settings.timestep, tuned.timestep
            moved = replace(settings, timestep=tuned.timestep, sample_every=tuned.sample_every)
        else:
            present, value = settings.options.get(name), tuned.options.get(name)
            moved = replace(settings, options=_with(settings.options, name, value))
        if present == value:
            continue
        settings = moved
        waiting.append(_words(name, present, value))
        after = asked.mean_error(settings)
        if after is not None:
            size = None if before is None else before - after
            shares.append(Share(DEFAULTS, ", ".join(waiting), before, after, size))
            before, waiting = after, []
    return shares


def _with(options: Mapping[str, Option], name: str, value: Option | None) -> dict[str, Option]:
    """Options with one of them set, or unset where there is no value."""
    if value is None:
        return {key: present for key, present in options.items() if key != name}
    return {**options, name: value}


def _words(option: str, before: Option | None, after: Option | None) -> str:
    return f"{option.replace('_', ' ')} {_short(before)} → {_short(after)}"


def _short(value: Option | None) -> str:
    if value is None:
        return "unset"
    return f"{value:.3g}" if isinstance(value, float) else str(value)
