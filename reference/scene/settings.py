"""Settings: how an implementation is to run a scenario. They are plain data, and any of them may be changed."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from reference import checks
from reference.errors import InvalidInput, UnknownName

Option = float | int | bool | str
SAMPLE_INTERVAL = 1e-3
"""Time between two samples of a trajectory, s, where the timestep allows it."""
ROUNDING = 1e-9
"""A duration needs no further sample for a remainder smaller than this share of a sample."""


@dataclass(frozen=True)
class Settings:
    """What an engine runs with.

    timestep: s. sample_every: steps between two samples of the trajectory. options: everything else, in the words
    of the engine that derived it (`stiffness`, `integrator`, `restitution_threshold`, …).
    """

    timestep: float
    sample_every: int = 1
    options: Mapping[str, Option] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "timestep", checks.positive("timestep", self.timestep))
        if not isinstance(self.sample_every, int) or self.sample_every < 1:
            raise InvalidInput(f"sample_every is {self.sample_every!r}; it must be a whole number of steps, at least 1")
        object.__setattr__(self, "options", MappingProxyType(dict(self.options)))

    def __reduce__(self) -> tuple[object, ...]:
        return Settings, (self.timestep, self.sample_every, dict(self.options))

    def __hash__(self) -> int:
        return hash((self.timestep, self.sample_every, tuple(sorted(self.options.items()))))

    def __getitem__(self, option: str) -> Option:
        try:
            return self.options[option]
        except KeyError:
            raise UnknownName("setting", option, self.options) from None

    def number(self, option: str) -> float:
        """Return an option that is a number."""
        return checks.finite(option, self[option])  # type: ignore[arg-type]

    def steps_for(self, duration: float) -> int:
        """How many steps, in whole samples, cover a duration, s; no further sample for a remainder that is rounding."""
        return self.sample_every * math.ceil(duration / (self.timestep * self.sample_every) - ROUNDING)

    def change(self, **changes: Option) -> Settings:
        """Return a copy with some values changed; a name that the engine did not derive is refused."""
        options = dict(self.options)
        fields: dict[str, Option] = {}
        for name, value in changes.items():
            if name == "timestep":
                fields["timestep"] = value
                fields.setdefault("sample_every", steps_per_sample(checks.positive("timestep", value)))  # type: ignore[arg-type]
            elif name == "sample_every":
                fields["sample_every"] = _same_kind(name, value, self.sample_every)
            elif name in options:
                options[name] = _same_kind(name, value, options[name])
            else:
                raise UnknownName("setting", name, ("timestep", "sample_every", *options))
        return replace(self, options=options, **fields)  # type: ignore[arg-type]

    def describe(self) -> str:
        """One line that a person can read: `timestep 0.001 s, erp 0, …`."""
        parts = [f"timestep {self.timestep:g} s"]
        for name, value in self.options.items():
            shown = f"{value:.6g}" if isinstance(value, float) else str(value)
            parts.append(f"{name.replace('_', ' ')} {shown}")
        return ", ".join(parts)


@dataclass(frozen=True)
class Move:
    """One setting to move, to see how much of an error is due to it.

    kind: what the setting belongs to, `contact model` or `solver`. option: its name. value: what it is moved to.
    """

    kind: str
    option: str
    value: Option


def steps_per_sample(timestep: float) -> int:
    """How many steps make one sample of about `SAMPLE_INTERVAL` seconds."""
    return max(1, round(SAMPLE_INTERVAL / timestep))


def _same_kind(name: str, value: Option, present: Option) -> Option:
    """Return `value` as the kind of option that is there: a switch, a word, a count or a number."""
    if isinstance(present, bool):
        if value in (True, False, "true", "false", "1", "0"):
            return value in (True, "true", "1")
        raise InvalidInput(f"{name} is {value!r}; it must be true or false")
    if isinstance(present, str):
        return str(value)
    number = checks.finite(name, value)  # type: ignore[arg-type]
    if not isinstance(present, int):
        return number
    if not number.is_integer():
        raise InvalidInput(f"{name} is {value!r}; it must be a whole number")
    return int(number)
