"""A page of the report made of results that nobody had to run, and a strict reader of it."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from html.parser import HTMLParser

from reference.catalogue.family import Family
from reference.catalogue.scenarios import catalogue
from reference.comparison.convergence import Errors
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import ALL_CASES, Row, Verdict
from reference.engines import engine_names, load_engine
from reference.report import page
from reference.report.sections import sections

VOID = {"meta", "br", "link", "img", "hr", "input", "col", "wbr", "source", "base", "area", "embed", "track"}
PICTURE = '<svg xmlns="http://www.w3.org/2000/svg" id="{name}-figure"><path id="{name}-path" d="M0 0"/></svg>'
REST = catalogue()["ball-to-rest"]
STUDY = Errors((2e-3, 1e-3), (0.02, 0.01), 1.0)


@dataclass(eq=False)
class Element:
    """An element of the page, with all the text inside it."""

    tag: str
    attributes: dict[str, str | None]
    inside: list[Element] = field(default_factory=list)
    words: list[str] = field(default_factory=list)

    def all(self, tag: str, name: str = "") -> list[Element]:
        """Elements of a tag at any depth, in the order of the page; of a class if one is given."""
        return [it for it in self.walk() if tag in ("", it.tag) and name in ("", *it.classes)]

    def walk(self) -> Iterator[Element]:
        """All elements at any depth, in the order of the page."""
        waiting = self.inside[::-1]
        while waiting:
            found = waiting.pop()
            yield found
            waiting += found.inside[::-1]

    @property
    def classes(self) -> list[str]:
        return (self.attributes.get("class") or "").split()

    @property
    def text(self) -> str:
        return " ".join("".join(self.words).split())


class Strict(HTMLParser):
    """Reads a page into a tree and refuses what a browser would quietly mend."""

    def __init__(self) -> None:
        super().__init__()
        self.root = Element("", {})
        self.open = [self.root]

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        names = [name for name, _ in attributes]
        assert len(set(names)) == len(names), f"<{tag}> has an attribute twice"
        element = Element(tag, dict(attributes))
        self.open[-1].inside.append(element)
        if tag not in VOID:
            self.open.append(element)
        elif tag == "br":
            self.handle_data(" ")

    def handle_startendtag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.open[-1].inside.append(Element(tag, dict(attributes)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open[-1].tag == tag, f"</{tag}> closes <{self.open[-1].tag}>"
        self.open.pop()

    def handle_data(self, data: str) -> None:
        for element in self.open:
            element.words.append(data)


def read(text: str) -> Element:
    reader = Strict()
    reader.feed(text)
    reader.close()
    assert reader.open == [reader.root], f"<{reader.open[-1].tag}> is never closed"
    return reader.root


def row(family: Family, quantity: str, case: str, job: Job, **changes) -> Row:
    entry = family.quantity(quantity)
    theory = {"expected": 0.25, "tolerance": 0.1, "reason": "a step late", "scale": 1.0} if entry.expect else {}
    verdict = Verdict.PASS if entry.expect else Verdict.SHOWN
    plain = Row(family.name, case, job.engine, job.profile, quantity, entry.unit, verdict, 0.26, **theory)
    return replace(plain, **changes)


def result(family: Family, name: str, profile: str) -> JobResult:
    engine, job = load_engine(name), Job(family.name, name, profile)
    scenario = family.cases[0].scenarios[0]
    settings = engine.settings(scenario, profile).describe()
    rows = tuple(
        row(family, quantity.name, case.name, job, settings=settings)
        for case in family.cases
        for quantity in family.quantities
    )
    described = engine.profiles(scenario)[profile]
    return JobResult(job, engine.title, described, rows, settings, "", convergence=STUDY)


@functools.cache
def everything() -> tuple[JobResult, ...]:
    """Every family in every engine and profile."""
    return tuple(
        result(family, name, profile)
        for family in catalogue().values()
        for name in engine_names()
        for profile in load_engine(name).profiles(family.cases[0].scenarios[0])
    )


def without_answer(given: JobResult, verdict: Verdict, note: str) -> JobResult:
    """What a job gives whose worker died, or whose engine is not there."""
    rows = (Row(given.job.family, ALL_CASES, given.job.engine, given.job.profile, "", "", verdict, note=note),)
    return replace(given, rows=rows, settings="", version="", convergence=None)


def written(results: Iterable[JobResult], with_figures: bool = True) -> str:
    found = sections(results)
    names = {it.family.name: [f"{it.family.name}-{kind}" for kind in ("trajectories", "convergence")] for it in found}
    pictures = {
        family: [(PICTURE.format(name=name), f"What {name} shows.") for name in own] for family, own in names.items()
    }
    shown = pictures if with_figures else dict.fromkeys(pictures, ())
    return page.render(found, shown, ["hand-written code", "an engine 3.2.7"], "Collisions Lab on a machine")


@functools.cache
def by_id(tree: Element) -> dict[str | None, Element]:
    return {it.attributes["id"]: it for it in tree.walk() if "id" in it.attributes}


def with_id(tree: Element, name: str) -> Element:
    return by_id(tree)[name]


def came_out(section: Element) -> Element:
    """The section's table of implementations: the first one."""
    return section.all("table")[0]


OURS = [result(REST, "handwritten", profile) for profile in ("exact", "slide", "step")]
