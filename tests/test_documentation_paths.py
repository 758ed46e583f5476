"""Files, folders and modules that the pages name are there: a move that leaves a page behind is found.

What `make docs` writes may be named where it is not written yet, and no page that is in git may lead there by a link.
"""

from __future__ import annotations

import functools
import re
import tomllib
from collections import Counter
from fnmatch import fnmatch
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md"))]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
TARGETS = PROJECT["tool"]["hatch"]["build"]["targets"]
BUILT = TARGETS["sdist"]["artifacts"]
"""Patterns of the files that `make docs` writes and git ignores, with a slash at the beginning."""
HISTORY = {"CHANGELOG.md"}
"""Pages that speak of what was."""
ELSEWHERE = ("labs/given", "labs.given")
"""What a student's tree alone has."""
_PLACEHOLDER = re.compile(r"[A-Z]{3,}")  # as in `tests/autograder/visible/test_TOPIC.py`
_PATH = re.compile(r"`((?:labs|reference|solutions|tests|docs)/[\w./*-]*)`")
_FILE = re.compile(
    r"`((?!(?:labs|reference|solutions|tests|docs)/)(?:\w+/)*\w+\.py)`"
)  # as in `reading.py` or `submission/reading.py`, wherever it lies
_MODULE = re.compile(r"(?<![\w./])((?:labs|reference|solutions)(?:\.\w+)+)")
_LINK = re.compile(r"\]\((?!\w+:)([^)#\s]+)[^)]*\)")
_ANCHOR = re.compile(r"\]\((?!\w+:)([^)#\s]*)#([^)\s]+)\)")
_HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)


def missing(page: Path) -> list[str]:
    """What a page names and is not there."""
    text = page.read_text(encoding="utf-8")
    named = [path for path in _PATH.findall(text) if not is_built(ROOT / path)]
    paths = [(ROOT, path) for path in named] + [(page.parent, link) for link in _LINK.findall(text)]
    lost = [path for folder, path in paths if not any(folder.glob(_PLACEHOLDER.sub("*", path)))]
    lost += [file for file in _FILE.findall(text) if not any(there.endswith(f"/{file}") for there in _files())]
    lost += [name for name in _MODULE.findall(text) if not _is_there(name)]
    return [name for name in lost if not name.startswith(ELSEWHERE)]


def is_built(path: Path) -> bool:
    """Whether `make docs` writes a file, or the files that a path with a placeholder stands for."""
    path = path.resolve()
    return path.is_relative_to(ROOT) and any(fnmatch(f"/{path.relative_to(ROOT).as_posix()}", each) for each in BUILT)


def links_to_built_files(page: Path) -> list[str]:
    """Links of a page to what `make docs` writes: they lead nowhere for a reader who looks at the page in git."""
    return [link for link in _LINK.findall(page.read_text("utf-8")) if is_built(page.parent / link)]


def missing_anchors(page: Path) -> list[str]:
    """Links of a page to headings that are not there, in itself or in another page."""
    links = [
        (page.parent / file if file else page, anchor) for file, anchor in _ANCHOR.findall(page.read_text("utf-8"))
    ]
    return [f"{file.name}#{anchor}" for file, anchor in links if file.suffix == ".md" and anchor not in _anchors(file)]


@functools.cache
def _anchors(page: Path) -> set[str]:
    """The anchors of a page's headings, as GitHub makes them: the second of a name has -1 at its end."""
    seen: Counter[str] = Counter()
    anchors = set()
    for heading in _HEADING.findall(page.read_text("utf-8")):
        name = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        anchors.add(f"{name}-{seen[name]}" if seen[name] else name)
        seen[name] += 1
    return anchors


@functools.cache
def _files() -> list[str]:
    """All Python files that belong to the lab."""
    folders = ("labs", "reference", "solutions", "tests", "docs")
    return [f"/{file.relative_to(ROOT).as_posix()}" for name in folders for file in (ROOT / name).rglob("*.py")]


def _is_there(name: str) -> bool:
    """Whether a dotted name is a package, a module, or something that the text of a module mentions."""
    whole = ROOT.joinpath(*name.split("."))
    package, _, member = name.rpartition(".")
    holder = ROOT.joinpath(*package.split("."))
    texts = [file for file in (holder.with_suffix(".py"), holder / "__init__.py") if file.is_file()]
    mentioned = any(re.search(rf"\b{member}\b", file.read_text(encoding="utf-8")) for file in texts)
    return whole.is_dir() or whole.with_suffix(".py").is_file() or mentioned


@pytest.mark.parametrize("page", [page for page in PAGES if page.name not in HISTORY], ids=lambda page: page.name)
def test_what_a_page_names_is_there(page):
    assert missing(page) + missing_anchors(page) == [], "run make docs, if this is a page that it writes"
    assert is_built(page) or links_to_built_files(page) == []


def test_what_make_docs_writes_is_ignored_by_git_and_packed():
    text = (ROOT / ".gitignore").read_text(encoding="utf-8")
    ignored = text.partition("# What `make docs` writes")[2].splitlines()[1:]
    assert sorted(ignored) == sorted(BUILT)
    packages = tuple(f"/{package}/" for package in TARGETS["wheel"]["packages"])
    assert TARGETS["wheel"]["artifacts"] == [pattern for pattern in BUILT if pattern.startswith(packages)]


@pytest.mark.parametrize("building", ["solutions", "reference", "labs", "labs/grading", "tests"])
def test_the_plan_of_the_house_shows_every_folder(building):
    plan = (ROOT / "docs" / "design.md").read_text(encoding="utf-8").partition("```")[2].partition("```")[0]
    folders = [path.name for path in (ROOT / building).iterdir() if any(path.glob("*.py")) and path.name[0] != "_"]
    mirrored = {"labs", "reference", "solutions"} if building == "tests" else set()
    assert [name for name in folders if f" {name}/" not in plan and name not in mirrored] == []


def test_what_has_moved_away_is_found(tmp_path):
    page = tmp_path / "page.md"
    page.write_text(
        "`reference/scenario.py`, `gone.py`, [a page](gone.md), `labs.seen` and `reference.scene.scenario.Nobody`"
    )
    assert missing(page) == [
        "reference/scenario.py",
        "gone.md",
        "gone.py",
        "labs.seen",
        "reference.scene.scenario.Nobody",
    ]
    page.write_text(
        "`reference/scene/`, `scene/scenario.py`, `reference.scene.scenario.Body`, [itself](page.md#there), (no link)"
    )
    assert missing(page) == []


def test_a_link_to_a_built_page_is_found(monkeypatch, tmp_path):
    page = tmp_path / "docs" / "page.md"
    page.parent.mkdir()
    page.write_text("`docs/instructors/never.md`, [one](course.md#x), ![two](images/engines/never.svg), [3](page.md)")
    monkeypatch.setitem(missing.__globals__, "ROOT", tmp_path)
    assert links_to_built_files(page) == ["course.md", "images/engines/never.svg"]
    assert missing(page) == ["course.md", "images/engines/never.svg"]


def test_a_link_to_a_heading_that_is_gone_is_found(tmp_path):
    page = tmp_path / "page.md"
    page.write_text(
        "# Two balls, rods\n## Rest\n## Rest\n[a](#two-balls-rods) [b](page.md#rest-1) [c](#rest-2) [d](#walls)"
    )
    assert missing_anchors(page) == ["page.md#rest-2", "page.md#walls"]
