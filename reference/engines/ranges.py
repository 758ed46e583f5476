"""Which values an engine's options may have. The engines themselves refuse hardly any: they run with nonsense."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass

from reference import checks
from reference.errors import InvalidInput
from reference.scene.settings import Option


@dataclass(frozen=True)
class Range:
    """Numbers from `least` to `most`. beyond: `least` itself is too small."""

    least: float = 0.0
    most: float = math.inf
    beyond: bool = False

    def __contains__(self, value: float) -> bool:
        return value <= self.most and (value > self.least if self.beyond else value >= self.least)

    def __str__(self) -> str:
        if self.most < math.inf:
            return f"from {self.least:g} to {self.most:.10g}"
        return f"above {self.least:g}" if self.beyond else f"at least {self.least:g}"


MOST_COUNTED = 2**31 - 1
"""The engines keep their counts in 32 bits with a sign."""
SHARE, NOT_NEGATIVE, POSITIVE = Range(0, 1), Range(), Range(beyond=True)
COUNT, COUNT_OR_NONE = Range(1, MOST_COUNTED), Range(0, MOST_COUNTED)
Allowed = Range | Collection[str]
"""What an option may be: a number in a range, or one of some words."""


def check_options(allowed: Mapping[str, Allowed], options: Mapping[str, Option]) -> None:
    """Raise `InvalidInput`, with the value and what is allowed, for an option that is out of its range."""
    for name, value in options.items():
        found = allowed.get(name)
        if isinstance(found, Range):
            if checks.finite(name, value) not in found:  # type: ignore[arg-type]
                raise InvalidInput(f"{name} is {value!r}; it must be {found}")
        elif found is not None and value not in found:
            raise InvalidInput(f"{name} is {value!r}; here it is one of {', '.join(found)}")
