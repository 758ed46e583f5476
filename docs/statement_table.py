"""Writes docs/statements.md: each statement of the lecture with its code, tests, oracles, scenarios and figures.

`make docs` runs it. Functions come from `reference.lecture`, tests from the marks `statement` and `erratum` in
`tests/`, figures from `docs/figures/`, what the implementations made of the scenarios from `docs/statement_engines.py`.
"""

from __future__ import annotations

import ast
import functools
import importlib
import importlib.util
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from labs.grading.submission.excerpts import TopicExcerpts
from reference.lecture import STATEMENTS, TOPICS, Statement, functions_of

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "statements.md"
HEAD = """# The statements of the lecture

Each statement of Rick Parent's *Collisions* (CIS 682): what the slide says, what is right, the function that puts it
into code, the tests that fail when its formula is broken and what they are judged by, the scenarios that put it to the
test in hand-written code and three engines, and a figure. `python docs/statement_table.py` writes this page from
`reference/lecture/functions.py`, the marks in `tests/`, `docs/statement_engines.py` and `docs/figures/`.

*Labs* are those whose functions belong to the statement, with the steps in which they come; what there is to read
after a lab counts as a step of it: {reading}. *Graded* counts the functions that a student writes for it and that
tests judge. Where nobody writes a function of the statement, it counts, after *within*, the written functions that
need one. *Read* means that its functions are only shown.

The columns of the four implementations count *scenarios*. The mark of a scenario is that of the worst of its numbers;
further down, the section of each statement has a count of all its numbers. The hand-written code runs by the method
`exact`, or by `world` where no other method can run the scenario, and each engine runs with its `tuned` settings. The
marks mean:

{legend}

"""


@dataclass(frozen=True)
class Test:
    """A test that bears on a statement. oracle: what judges it; empty for one that shows an erratum."""

    path: str
    name: str
    statement: int
    oracle: str


@functools.cache
def marked_tests() -> list[Test]:
    """All tests with a mark `statement` or `erratum`, in the order of files and lines."""
    return [test for path in sorted((ROOT / "tests").rglob("test_*.py")) for test in _tests_in(path)]


def _tests_in(path: Path) -> Iterator[Test]:
    where = path.relative_to(ROOT).as_posix()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef):
            for mark in node.decorator_list:
                if isinstance(mark, ast.Call) and ast.unparse(mark.func) in (
                    "pytest.mark.statement",
                    "pytest.mark.erratum",
                ):
                    given = {keyword.arg: ast.literal_eval(keyword.value) for keyword in mark.keywords}
                    values = [ast.literal_eval(value) for value in mark.args]
                    number = given.get("number", values[0] if values else None)
                    oracle = given.get("oracle", values[1] if len(values) > 1 else "")
                    yield Test(where, node.name, number, oracle)


@functools.cache
def drawing() -> ModuleType:
    """The program that draws the figures."""
    return _program("figures/draw.py")


@functools.cache
def statement_engines() -> ModuleType:
    """The program that collects what the implementations made of the scenarios."""
    return _program("statement_engines.py")


def _program(place: str) -> ModuleType:
    path = ROOT / "docs" / place
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    program = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(program)
    return program


@functools.cache
def figures() -> list[tuple[int, str, str]]:
    """Statement, name and caption of every figure."""
    return [
        (number, drawing().file_name(number, name), " ".join((function.__doc__ or "").split()))
        for (number, name), function in drawing().figures().items()
    ]


def page() -> str:
    """The whole page."""
    tests, drawn = marked_tests(), figures()
    legend = "\n".join(f"- {line}" for line in statement_engines().legend())
    head = HEAD.format(legend=legend, reading=", ".join(_read_afterwards()))
    return head + _overview(tests, drawn) + "".join(_section(entry, tests, drawn) for entry in STATEMENTS)


def _read_afterwards() -> list[str]:
    """The labs whose last step has no function that a student writes, each with that step."""
    last = {topic.name: max(entry.step for entry in functions_of(topic.name)) for topic in TOPICS}
    writing = {(entry.topic, entry.step) for name in last for entry in functions_of(name) if entry.role == "written"}
    return [f"{name} {step}" for name, step in last.items() if (name, step) not in writing]


def _functions(number: int) -> list[tuple[str, str]]:
    """Name and file of the functions that belong to a statement."""
    entries = [entry for topic in TOPICS for entry in functions_of(topic.name) if entry.statement == number]
    return [(entry.name, _file_of(entry.topic, entry.name)) for entry in entries]


def _labs(number: int) -> str:
    """The labs that have functions of a statement, each with the steps in which these come."""
    found = {
        topic.name: sorted({entry.step for entry in functions_of(topic.name) if entry.statement == number})
        for topic in TOPICS
    }
    return "; ".join(f"{topic} {', '.join(map(str, steps))}" for topic, steps in found.items() if steps)


def _graded(number: int) -> str:
    """How many functions a student writes for a statement; else how many need one of it; else that it is read."""
    own = {entry.name for topic in TOPICS for entry in functions_of(topic.name) if entry.statement == number}
    written = [entry for topic in TOPICS for entry in functions_of(topic.name) if entry.role == "written"]
    direct = [entry for entry in written if entry.name in own]
    if direct:
        return str(len(direct))
    indirect = sum(bool(own & _needed(entry.topic, entry.name)) for entry in written)
    return f"within {indirect}" if indirect else "read"


@functools.cache
def _needed(topic: str, name: str) -> frozenset[str]:
    """The names that a solution needs, directly or through others."""
    return frozenset(each for excerpt in _excerpts(topic).needed([name]) for each in excerpt.defines)


_excerpts = functools.cache(TopicExcerpts.of)


def _file_of(topic: str, name: str) -> str:
    found = getattr(importlib.import_module(f"solutions.{topic}"), name)
    return found.__module__.replace(".", "/") + ".py"


def _overview(tests: list[Test], drawn: list[tuple[int, str, str]]) -> str:
    engines = statement_engines()
    names = [engines.title(name) for name in engines.IMPLEMENTATIONS]
    lines = [
        "| # | statement | topic | labs | graded | functions | tests | oracles | errata shown | "
        + " | ".join(names)
        + " | figures |",
        "|---|---|---|---|---|---|---|---|---|" + "---|" * len(names) + "---|",
    ]
    for entry in STATEMENTS:
        own = [test for test in tests if test.statement == entry.number]
        judged = [test for test in own if test.oracle]
        shown = len(own) - len(judged) if entry.erratum else "–"
        counts = (
            _labs(entry.number),
            _graded(entry.number),
            len(_functions(entry.number)),
            len(judged),
            len({test.oracle for test in judged}),
            shown,
            *(engines.cell(entry.number, name) for name in engines.IMPLEMENTATIONS),
            sum(number == entry.number for number, _, _ in drawn),
        )
        link = f"[{entry.title}](#{entry.number}-{_anchor(entry.title)})"
        lines.append(f"| {entry.number} | {link} | {entry.topic} | " + " | ".join(map(str, counts)) + " |")
    return "\n".join(lines) + "\n"


def _anchor(title: str) -> str:
    return "".join(sign for sign in title.lower().replace(" ", "-") if sign.isalnum() or sign == "-")


def _section(entry: Statement, tests: list[Test], drawn: list[tuple[int, str, str]]) -> str:
    lines = [f"\n## {entry.number} {entry.title}", "", f"**Slide.** {entry.slide}", "", f"**Right.** {entry.right}", ""]
    if entry.erratum:
        lines += [f"**Erratum or gap.** {entry.erratum}", ""]
    functions = [f"[`{name}`](../{path})" for name, path in _functions(entry.number)]
    if functions:
        lines += [f"**By hand.** {', '.join(functions)}", ""]
    own = [test for test in tests if test.statement == entry.number]
    rows = [
        f"| {test.name.removeprefix('test_').replace('_', ' ')} | {test.oracle or 'the slide’s formula fails'} |"
        f" [{Path(test.path).name}](../{test.path}) |"
        for test in own
    ]
    if rows:
        lines += ["| what is tested | judged by | where |", "|---|---|---|", *rows, ""]
    lines += _scenarios(entry.number)
    for number, name, caption in drawn:
        if number == entry.number:
            lines += [f"![{caption}](images/statements/{name})", "", f"*{caption}*", ""]
    return "\n".join(lines)


def _scenarios(number: int) -> list[str]:
    """A table of the scenarios that put a statement to the test."""
    engines = statement_engines()
    families = engines.families(number)
    if not families:
        return []
    lines = [
        "| scenario | " + " | ".join(engines.title(name) for name in engines.IMPLEMENTATIONS) + " |",
        "|---" * (1 + len(engines.IMPLEMENTATIONS)) + "|",
    ]
    for family in families:
        found = " | ".join(engines.numbers(family, name) for name in engines.IMPLEMENTATIONS)
        lines.append(f"| `{family}` | {found} |")
    return [*lines, ""]


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8", newline="\n")
