"""What `lab.derive` prints: which line of a derivation is asked for, and whether a student's line is right."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from labs.grading.wrapping import folded
from labs.guidance.derivations import POINTS, Derivation
from labs.guidance.expressions import UNDERSTOOD
from labs.guidance.hint_files import Guide
from reference.errors import InvalidInput


def asked(guide: Guide, lefts: Collection[str] = ()) -> Iterator[str]:
    """What there is to derive for a function, line by line. lefts: of these lines alone; of all if there are none.

    Raises
    ------
    InvalidInput
        If no such line is asked for.
    """
    for derivation in map(guide.derivation, lefts) if lefts else guide.derivations:
        meaning = f", {derivation.asked}," if derivation.asked else ""
        yield f"Find {derivation.left}{meaning} from"
        width = max(len(name) for name in derivation.names)
        yield from (f"    {each.name:<{width}}  {each.meaning}" for each in derivation.quantities)
        yield f'and write it as lab.derive("{guide.function}", {derivation.left}="…").'
    if guide.derivations:
        yield from folded(f"A line may hold numbers, these names, {UNDERSTOOD}. Every right form of it counts.", 0)
    else:
        yield f"Of {guide.function} no line is asked for."


def judged(guide: Guide, lines: Mapping[str, object]) -> Iterator[str]:
    """For each line that a student gives, whether it is right, and where it is not.

    Raises
    ------
    InvalidInput
        If no such line is asked for, or a line cannot be understood.
    """
    for left, line in lines.items():
        derivation = guide.derivation(left)
        if not isinstance(line, str):
            raise InvalidInput(f'write the line between quotes, as in {left}="{derivation.names[0]} + 1"')
        yield from _judged(derivation, line)


def _judged(derivation: Derivation, line: str) -> Iterator[str]:
    found = derivation.read(line)
    said = f"{derivation.left} = {found.text}"
    if difference := derivation.difference(found):
        yield f"✗ {said}"
        yield from folded(difference, 1)
    else:
        yield from folded(f"✓ {said} is right: it was tried at round numbers and at {POINTS} random ones.", 0)
