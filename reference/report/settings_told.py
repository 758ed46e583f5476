"""What each implementation is told, in sentences: first what it is told in every scenario, then the rest in each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from markupsafe import Markup, escape

from reference.engines.settings_in_words import sentence_and_value
from reference.report import numbers
from reference.report.overview import columns
from reference.report.sections import Line, Section

_DIGITS = 6
"""As many digits of a value as `Settings.describe` writes."""


@dataclass(frozen=True)
class Told:
    """One implementation. method: its profile in words. sentences: one for each setting, with code between backticks.

    as_in: the section further up that says the very same of it; None where the sentences are new.
    """

    title: str
    method: str
    sentences: tuple[str, ...]
    as_in: Section | None = None


def everywhere(found: Sequence[Section]) -> list[Told]:
    """What each implementation is told alike in all scenarios; no implementation that has numbers in one alone."""
    told = []
    for title in columns(found):
        lines = [line for section in found if (line := section.line(title)) and sentences(line)]
        if len(lines) > 1:
            shared = set.intersection(*(set(sentences(line)) for line in lines))
            own = tuple(sentence for sentence in sentences(lines[0]) if sentence in shared)
            methods = dict.fromkeys(line.result.description for line in lines)
            told.append(Told(title, ", or ".join(methods), own))
    return told


def by_scenario(found: Sequence[Section], shared: Sequence[Told]) -> dict[str, list[Told]]:
    """By family, what each implementation is told there, less what it is told everywhere; if anything is left."""
    known = {told.title: told.sentences for told in shared}
    said: dict[tuple[str, tuple[str, ...]], Section] = {}
    by_name: dict[str, list[Told]] = {section.family.name: [] for section in found}
    for section in found:
        for line in section.lines:
            own = tuple(sentence for sentence in sentences(line) if sentence not in known.get(line.title, ()))
            if own:
                first = said.setdefault((line.title, own), section)
                as_in = first if first is not section else None
                by_name[section.family.name].append(Told(line.title, line.result.description, own, as_in))
    return by_name


def sentences(line: Line) -> tuple[str, ...]:
    """A sentence for each setting of those cases that have a number; it says so where the cases differ."""
    cases: set[str] = set()
    found: dict[str, dict[str, set[str]]] = {}
    for row in line.result.rows:
        if row.quantity and row.settings and row.case not in cases:
            cases.add(row.case)
            for setting in row.settings.split(", "):
                sentence, value = sentence_and_value(line.result.job.engine, setting)
                found.setdefault(sentence, {}).setdefault(value, set()).add(row.case)
    return tuple(_said(sentence, values, len(cases)) for sentence, values in found.items())


def code_typed(text: str) -> Markup:
    """A sentence for the page: what is between backticks in code type, and everything escaped."""
    parts = [escape(part) for part in text.split("`")]  # prose and code in turn
    return Markup("").join(Markup(f"<code>{part}</code>") if place % 2 else part for place, part in enumerate(parts))


def _said(sentence: str, values: Mapping[str, set[str]], cases: int) -> str:
    """A sentence with its value, or with all values that it has, and in how many of the cases."""
    shown = [_value(value) for value in values]
    times = [_value(value.removesuffix(" s"), "s") for value in values]
    text = sentence.format(_either(shown), s=_either(times), m=f"{_either(shown)} m")
    having = len(set[str]().union(*values.values()))
    where = [f"in {having} of {cases} cases"] * (having < cases) + ["depending on the case"] * (len(values) > 1)
    return f"{', '.join([text.removesuffix('.'), *where])}." if where else text


def _value(text: str, unit: str = "") -> str:
    try:
        value = float(text)
    except ValueError:
        return text
    return numbers.size(value, unit) if unit else numbers.digits(value, _DIGITS).removeprefix("1·")


def _either(texts: Sequence[str]) -> str:
    *first, last = texts
    return f"{', '.join(first)} or {last}" if first else last
