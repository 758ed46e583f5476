"""Reads `labs/hints/TOPIC.md`: for each function its derivations and three levels of hints, and what was to predict.

    ## impulse_magnitude

    ```derive
    j = -(1 + e) * u / k
    j: size of the impulse, N s
    u: normal velocity before the impact, m/s, -5 to -1
    ```

    ### The idea
    Text with $formulas$ and ![alternative text](figure:contact).

    ### The next line
    ### The formula

    ## Predictions

    - corner: zero — the reason, in a sentence
    - passed: 0.4 ± 0.05 — of an engine theory says nothing, so the number is given here
    - rebound — theory has the number: only the reason

A line of a derivation that describes its left side has no range; it may be left out. A quantity that follows from
those above it has its value in place of a range, as in `s: sine of the angle, = sqrt(1 - c**2)`.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from labs.guidance.derivations import Derivation, Quantity, check_range
from labs.guidance.expressions import expression
from labs.project_folders import HINTS
from reference import lecture
from reference.errors import InvalidInput

LEVELS = ("The idea", "The next line", "The formula")
"""The headings of the three levels, in the order in which they are revealed."""
PREDICTIONS = "Predictions"
_BLOCK = re.compile(r"^```derive\n(.*?)^```\n?", re.MULTILINE | re.DOTALL)
_LINE = re.compile(r"^(\w+)\s*=\s*([^=].*)$")
_RANGE = re.compile(r"^(.*),\s*(\S+) to (\S+)$")
_FOLLOWS = re.compile(r"^(.*),\s*=\s*(\S.*)$")
_ANSWER = re.compile(r"^-\s+`?([\w-]+)`?(?::\s*(.*?))?(?:\s+—\s+|$)(.*)$", re.DOTALL)
_NUMBER = re.compile(r"^([-−+]?[\d.]+(?:e[-+]?\d+)?)(?:\s*±\s*([\d.]+(?:e[-+]?\d+)?))?$")


@dataclass(frozen=True)
class Guide:
    """What the hints say of one function: its derivations, and its levels in order, each a title with a text."""

    function: str
    derivations: tuple[Derivation, ...] = ()
    titled: tuple[tuple[str, str], ...] = ()

    @property
    def levels(self) -> tuple[str, ...]:
        """The texts of the levels."""
        return tuple(text for _, text in self.titled)

    def derivation(self, left: str) -> Derivation:
        """The derivation of one left side."""
        for each in self.derivations:
            if each.left == left:
                return each
        names = " and ".join(each.left for each in self.derivations) or "none"
        raise InvalidInput(f"of {self.function} no line {left} = … is asked for; there is {names}")


@dataclass(frozen=True)
class Answer:
    """What is right of a prediction. said: in words or as a number, empty if theory has it. within: of a number."""

    said: str = ""
    number: float | None = None
    within: float | None = None
    reason: str = ""


@dataclass(frozen=True)
class Hints:
    """All that one file says."""

    topic: str
    guides: dict[str, Guide] = field(default_factory=dict)
    answers: dict[str, Answer] = field(default_factory=dict)

    def of(self, function: str) -> Guide:
        """What is said of a function; empty if the file has no section of it."""
        return self.guides.get(function, Guide(function))


def hints(topic: str) -> Hints:
    """Read the hints of a topic; there are none if it has no file.

    Raises
    ------
    InvalidInput
        If the file is not written as above; the message names the file and the section.
    """
    path = HINTS / f"{topic}.md"
    if not path.is_file():
        return Hints(topic)
    return _read(path, path.stat().st_mtime_ns)


@cache
def _read(path: Path, changed: int) -> Hints:
    found = Hints(path.stem)
    for heading, body in _parts(path.read_text(encoding="utf-8"), "## "):
        try:
            if heading == PREDICTIONS:
                found.answers.update(_answers(body))
            elif heading not in lecture.FUNCTIONS:
                raise InvalidInput("there is no function of this name in the lecture")
            elif heading in found.guides:
                raise InvalidInput("there are two sections of this name")
            else:
                found.guides[heading] = _guide(heading, body)
        except InvalidInput as error:
            raise InvalidInput(f"hints/{path.name}, section {heading}: {error}") from None
    return found


def _parts(text: str, mark: str) -> Iterator[tuple[str, str]]:
    """The headings that begin with a mark, each with the text below it."""
    for part in re.split(rf"^{mark}", text, flags=re.MULTILINE)[1:]:
        heading, _, body = part.partition("\n")
        yield heading.strip(), body.strip()


def _guide(function: str, body: str) -> Guide:
    derivations = tuple(derivation(block) for block in _BLOCK.findall(body))
    texts = dict(_parts(_BLOCK.sub("", body), "### "))
    if unknown := [heading for heading in texts if heading not in LEVELS]:
        raise InvalidInput(f"“{unknown[0]}” is no level of hints: they are {', '.join(LEVELS)}")
    return Guide(function, derivations, tuple((heading, texts[heading]) for heading in LEVELS if texts.get(heading)))


def derivation(block: str) -> Derivation:
    """The derivation that a block describes.

    Raises
    ------
    InvalidInput
        If its first line is no equation, or another one describes no quantity.
    """
    first, *others = [line.strip() for line in block.strip().split("\n") if line.strip()]
    equation = _LINE.match(unicodedata.normalize("NFKC", first))
    if equation is None:
        raise InvalidInput(f"“{first}” is no line such as j = -(1 + e) * u / k")
    left, right = equation.groups()
    asked, quantities = "", list[Quantity]()
    for line in others:
        name, colon, meaning = (part.strip() for part in line.partition(":"))
        name = unicodedata.normalize("NFKC", name)  # as Python reads a name; a unit such as m² stays as it is
        found, follows = _RANGE.match(meaning), _FOLLOWS.match(meaning)
        if follows and name.isidentifier():
            before = [each.name for each in quantities]
            quantities.append(Quantity(name, follows[1], follows=expression(follows[2], before)))
            continue
        if colon and name == left and found is None:
            asked = meaning
            continue
        if not colon or not name.isidentifier() or found is None:
            raise InvalidInput(f"“{line}” is no quantity such as e: coefficient of restitution, 0 to 1")
        quantities.append(Quantity(name, found[1], *_range(line, found[2], found[3])))
    if all(each.follows for each in quantities):
        raise InvalidInput(f"“{first}” names no quantities")
    made = Derivation(left, expression(right, [each.name for each in quantities]), tuple(quantities), asked)
    check_range(made)
    return made


def _range(line: str, low: str, high: str) -> tuple[float, float]:
    try:
        found = float(low.replace("−", "-")), float(high.replace("−", "-"))
    except ValueError:
        raise InvalidInput(f"the range of “{line}” is not two numbers") from None
    if not found[0] < found[1]:
        raise InvalidInput(f"the range of “{line}” is empty")
    return found


def _answers(body: str) -> Iterator[tuple[str, Answer]]:
    for item in re.split(r"\n(?=- )", body):
        if not item.startswith("- "):
            continue
        found = _ANSWER.match(" ".join(item.split()))
        if found is None or not found[3]:
            raise InvalidInput(f"“{item}” is no line such as - corner: zero — the reason")
        key, said, reason = found[1], (found[2] or "").strip("`“”'\""), found[3]
        number = _NUMBER.match(said)
        if number:
            value = float(number[1].replace("−", "-"))
            yield key, Answer(said, value, float(number[2]) if number[2] else None, reason)
        else:
            yield key, Answer(said, reason=reason)
