"""Many steps, with forces that depend on the state (slides 23 to 29)."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite
from solutions.domain import domain, require
from solutions.world.bodies import Bodies, State
from solutions.world.memory import NOTHING, Memory
from solutions.world.rules import Rules
from solutions.world.step import advance_world, one_number

Forces = (
    Callable[[State], tuple[Array, Array]]
    | Callable[[State, float], tuple[Array, Array]]
)
"""Forces and torques on all bodies, (n, 3) each, N and N m."""
OneNumber = Annotated[float, finite, one_number]
"""One number, finite."""
UNSTABLE = (
    "; a spring, a damper or a penalty contact makes a motion grow without end"
    " if dt is beyond its step limit: see `spring_step_limit` of"
    " solutions.forces and `penalty_step_limit` of solutions.response"
)
RUNAWAY = 1e9
"""A speed and a spin that no body of a right scene has, m/s and rad/s.

It is beyond the speed of light, and such a spin tears all but specks of dust
apart.
"""


class Run(State):
    """The states of a run, whose arrays have one more axis in front.

    Attributes
    ----------
    position, orientation, velocity, angular_velocity : (k, n, 3) or (k, n, 4)
        One entry for each state kept, as in `State`.
    memory : what the last step left
    """

    memory: Memory = NOTHING


@domain
def run_world(
    bodies: Bodies,
    state: State,
    acceleration: ArrayLike,
    dt: OneNumber,
    steps: int,
    rules: Rules = Rules(),  # noqa: B008  (an immutable tuple)
    forces: Sequence[Forces] = (),
    every: int = 1,
    memory: Memory = NOTHING,
    time: OneNumber = 0.0,
) -> Run:
    """The states of a world over many steps.

    Parameters
    ----------
    bodies, state : the world at the start
    acceleration : (3,) or (n, 3), g, m/s²
    dt : s
    steps : how many, a whole number
    rules : how it responds to contacts
    forces : functions, such as springs, drag and wind
        Each takes the state, and returns the forces and the torques on all
        bodies, (n, 3) each, N and N m. A function that needs one argument more
        is given the time as well, f(state, t), in s. An argument with a
        default is not needed.
    every : a whole number; a state is kept after so many steps
    memory : what another run left, which this one continues
    time : when the run starts, s

    Returns
    -------
    Run, the states that were kept, and the memory of the last step
        The first state is the start.

    Raises
    ------
    ValueError
        If a number of steps is not whole or too small, forces do not fit, a
        motion grows without end, or as `advance_world`.

    Notes
    -----
    A run can be continued from the state after its last step, which is kept if
    `every` divides `steps`. With its memory the second part is the same as if
    the run had continued, to the last digit, or to rounding of the time where
    forces depend on it:

        first = run_world(bodies, start, g, dt, 100)
        last = State(*(array[-1] for array in first))
        second = run_world(
            bodies, last, g, dt, 100, memory=first.memory, time=100 * dt
        )

    Without it the contacts begin without impulses, and no body is asleep. The
    first steps then take more sweeps than the others, so that what stands
    remains standing.

    The forces act at the beginning of each step, as semi-implicit Euler takes
    them:

        v⁺ = v + Δt F(x, v, t)/m
        x⁺ = x + Δt v⁺
    """
    for name, count, least in (("steps", steps, 0), ("every", every, 1)):
        is_whole = isinstance(count, int | np.integer)
        if not is_whole or isinstance(count, bool) or count < least:
            raise ValueError(
                f"{name} must be a whole number from {least}, not {count!r}"
            )
    require(
        isinstance(forces, Sequence) and all(map(callable, forces)),
        f"forces must be a list of functions, not {forces!r}",
    )
    kept = [state]
    acting = [
        _with_time(f"forces[{i}]", force) for i, force in enumerate(forces)
    ]
    for count in range(1, steps + 1):
        now = time + (count - 1) * dt
        loads = np.zeros((2, len(bodies.inverse_mass), 3))
        for i, force in enumerate(acting):
            loads += _checked(f"forces[{i}]", force(state, now), loads, now)
        state, memory, _ = advance_world(
            bodies, state, acceleration, dt, rules, memory, *loads
        )
        if not all(np.all(np.isfinite(part)) for part in state):
            raise ValueError(
                f"the motion is not finite at {now + dt:g} s{UNSTABLE}"
            )
        fastest = np.max(np.abs(state[2:]), initial=0.0)
        if fastest > RUNAWAY:
            raise ValueError(
                f"a body has reached {fastest:.2g} m/s or rad/s at"
                f" {now + dt:g} s{UNSTABLE}"
            )
        if count % every == 0:
            kept.append(state)
    run = Run(*(np.stack(parts) for parts in zip(*kept, strict=True)))
    run.memory = memory
    return run


def _with_time(
    name: str, force: Callable[..., Any]
) -> Callable[[State, float], Any]:
    """The function of the state, and of the time if it needs that."""
    try:
        parameters = inspect.signature(force).parameters.values()
    except (TypeError, ValueError):  # a function of C does not always tell
        return lambda state, now: force(state)
    needed = [
        parameter
        for parameter in parameters
        if parameter.default is parameter.empty
        and parameter.kind
        not in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
    ]
    if len(needed) == 1 or (not needed and parameters):
        return lambda state, now: force(state)
    if len(needed) != 2:
        names = ", ".join(argument.name for argument in needed) or "nothing"
        raise ValueError(
            f"{name} must be a function of the state, or of the state and the"
            f" time, not of {names}"
        )
    last = needed[1]
    if last.kind is last.KEYWORD_ONLY:
        return lambda state, now: force(state, **{last.name: now})
    return lambda state, now: force(state, now)


def _checked(name: str, given: Any, loads: Array, now: float) -> Array:
    """What a function of `forces` returned, (2, n, 3); refuse all else."""
    refusal = (
        f"{name} must return forces and torques, two arrays of the shape"
        f" {loads.shape[1:]} each, not"
    )
    if not isinstance(given, tuple | list | np.ndarray):
        raise ValueError(f"{refusal} {type(given).__name__}")
    if len(given) != 2:
        raise ValueError(f"{refusal} {len(given)} of them")
    try:
        parts = [np.asarray(part) for part in given]
    except ValueError:
        raise ValueError(f"{refusal} rows of unequal length") from None
    for part in parts:
        if part.shape != loads.shape[1:] or part.dtype.kind not in "iuf":
            raise ValueError(f"{refusal} {part.dtype} of {part.shape}")
    both = np.array(parts, dtype=float)
    if not np.all(np.isfinite(both)):
        first = both[~np.isfinite(both)][0]
        raise ValueError(f"{name} returned {first} at {now:g} s{UNSTABLE}")
    return both
