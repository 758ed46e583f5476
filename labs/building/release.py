"""Writes the tree that a student gets: no solutions, hidden tests, known mistakes or pages for the instructor.

Functions of closed labs, and those of other labs that the runs of the open labs need, are released as `labs/given`. If
students write such a function in an open lab or in a later one, its text is packed: perhaps they write it next week. Of
a lab that is not open nothing else is in the tree: no visible test, no hint, no figure.
"""

from __future__ import annotations

import base64
import re
import shutil
import tempfile
import textwrap
import zlib
from collections.abc import Collection, Sequence
from pathlib import Path

from labs.building import lessons, notebooks
from labs.building.archives import files_below, pack
from labs.building.guidance_gaps import figures_named
from labs.building.release_readme import readme
from labs.grading.submission.excerpts import TopicExcerpts, imports_of, text_of, without_notes
from labs.guidance import drawings
from labs.guidance.hint_files import hints
from labs.project_folders import ROOT
from reference import lecture
from reference.errors import InvalidInput
from reference.writable import check_file, new_folder_for, refused_in_words

NAME = "collisions-lab"
_FOLDERS = ("labs", "reference", "tests/autograder/visible")
_FILES = ("pyproject.toml", "constraints.txt", "bullet.txt", "LICENSE")
_LEFT_OUT = (
    "labs/building", "labs/lessons", "labs/notebooks", "labs/given", "labs/cli/lab.py", "labs/gradebook",
    "labs/cli/grade.py", "labs/cli/export.py",
)  # fmt: skip
"""Code that makes notebooks and grades classes, and files that hold model answers. Notebooks and given functions are
made per release."""
_SUSPECTS = "labs/assessment/suspects"
_UNPACK = """\
import base64
import zlib

# Packed, so that nobody reads in passing what a lab asks for.
exec(zlib.decompress(base64.b85decode"""
_OF_LABS = (
    "tests/autograder/visible",
    "labs/grading/diagnosis/probes",
    "labs/grading/diagnosis/fingerprints",
    "labs/hints",
    _SUSPECTS,
)
"""Folders with files that each belong to one lab and are named after it."""
_FIGURES = "labs/figures"
_STATEMENTS = "reference/lecture/statements.py"
_ANSWER = re.compile(r"""(right|erratum)=(?:"[^"]*"\s*)+""")
"""What a slide should say, and what is wrong with it, in the file of the statements."""
_CONTENT, _OPTION = "the release", "--out"


def release(out: Path, through: str | None = None, only: Sequence[str] = ()) -> list[str]:
    """Write a tree of labs, as a folder or, if the name ends in `.zip`, as an archive.

    through: the last lab. Those before it are closed, and their answers are released. Without it no lab is closed.
    only: the labs of the course, all that have a lesson if it names none. Returns the labs in the tree.

    Raises
    ------
    InvalidInput
        If there is already such a folder and it is not empty, if it cannot be written, if that lab has no lesson, if
        the last lab is none of the course, if a figure is not drawn yet, or if this is an installed copy of the lab
        rather than the project's folder.
    """
    missing = [name for name in (*_FOLDERS, *_FILES) if not (ROOT / name).exists()]
    if missing:
        raise InvalidInput(f"a release is made from the project's folder; this copy of the lab lacks {missing[0]}")
    open_labs = _course(only)
    closed = set[str]()
    if through is not None:
        last = _with_lesson(through)
        if last not in open_labs:
            raise InvalidInput(f"{last} is not among the labs of the release, {', '.join(open_labs)}")
        open_labs = [topic for topic in open_labs if _number(topic) <= _number(last)]
        closed = set(open_labs[:-1]) if only else _before(last)
    if undrawn := sorted(_shown(open_labs) - {*drawings.names()}):
        raise InvalidInput(f"a release needs labs/figures/{undrawn[0]}.svg, which is not there: `make docs` draws it")
    if out.suffix == ".zip":
        check_file(_CONTENT, out, _OPTION)
        with refused_in_words(_CONTENT, out, _OPTION), tempfile.TemporaryDirectory() as folder:
            _write(Path(folder, NAME), open_labs, closed, out.name)
            pack(out, files_below(Path(folder)))
    else:
        with new_folder_for(_CONTENT, out, _OPTION):
            _write(out, open_labs, closed)
    return open_labs


def given(open_labs: Collection[str], closed: Collection[str] = ()) -> dict[str, str]:
    """The modules of `labs/given`: all of closed labs, what open labs give, and what they borrow from other labs.

    What contains an answer of an open lab, or of one that comes later, is packed.
    """
    wanted = {name: [entry.name for entry in lecture.functions_of(name)] for name in closed}
    shown = [entry.name for topic in open_labs for entry in lecture.functions_of(topic) if entry.role == "given"]
    for name in (*shown, *(lent for topic in open_labs for lent in lessons.read(topic).lent)):
        found = wanted.setdefault(lecture.function(name).topic, [])
        found += [name] * (name not in found)
    last = max(map(_number, open_labs), default=-1)
    still = {*open_labs, *(topic.name for topic in lecture.TOPICS if _number(topic.name) > last)} - {*closed}
    asked = {entry.name for topic in still for entry in lecture.functions_of(topic) if entry.role == "written"}
    return {topic: _module(topic, names, asked) for topic, names in sorted(wanted.items()) if names}


def _before(last: str) -> set[str]:
    """The topics before a lab: their time is over."""
    return {topic.name for topic in lecture.TOPICS[: _number(last)]}


def _course(only: Sequence[str]) -> list[str]:
    """The labs that are named, or all that there are, in the order of teaching."""
    return sorted({_with_lesson(name) for name in only}, key=_number) or list(lessons.lessons())


def _with_lesson(lab: str) -> str:
    """The name of a lab that has a lesson."""
    name, there = lecture.topic(lab).name, lessons.lessons()
    if name not in there:
        raise InvalidInput(f"{name} has no lesson yet; there are lessons of {', '.join(there)}")
    return name


def _number(topic: str) -> int:
    """Where a topic comes in the order of teaching, from 0."""
    return [each.name for each in lecture.TOPICS].index(topic)


def _write(out: Path, open_labs: Sequence[str], closed: Collection[str], archive: str = "") -> None:
    out.mkdir(parents=True, exist_ok=True)
    for name in _FOLDERS:
        shutil.copytree(ROOT / name, out / name, ignore=_ignored, dirs_exist_ok=True)
    _remove_other_labs(out, open_labs)
    _hide_answers(out, open_labs)
    for name in _FILES:
        shutil.copy(ROOT / name, out / name)
    project = out / "pyproject.toml"
    project.write_text(_for_students(project.read_text(encoding="utf-8")), encoding="utf-8")
    for topic in open_labs:
        path = out / "labs" / "notebooks" / f"{topic}.ipynb"
        path.parent.mkdir(exist_ok=True)
        path.write_text(notebooks.text(notebooks.student(topic)), encoding="utf-8")
    folder = out / "labs" / "given"
    folder.mkdir()
    (folder / "__init__.py").write_text('"""Functions that are given: answers of labs that are closed."""\n')
    for topic, text in given(open_labs, closed).items():
        (folder / f"{topic}.py").write_text(text, encoding="utf-8")
    (out / "README.md").write_text(readme(NAME, open_labs, archive), encoding="utf-8")


def _remove_other_labs(out: Path, open_labs: Collection[str]) -> None:
    """Remove what belongs to labs that are not open, and the figures that no open lab shows."""
    others = {topic.name for topic in lecture.TOPICS} - set(open_labs)
    for folder in _OF_LABS:
        for path in (out / folder).glob("*.*"):
            name = path.stem.removeprefix("test_")
            if any(name == other or name.startswith(f"{other}_") for other in others):
                path.unlink()
    shown = _shown(open_labs)
    for path in (out / _FIGURES).glob("*.svg"):
        if path.stem not in shown:
            path.unlink()


def _shown(open_labs: Collection[str]) -> set[str]:
    """The figures that these labs show."""
    return {name for topic in open_labs for name in figures_named(lessons.read(topic), hints(topic))}


def _hide_answers(out: Path, open_labs: Collection[str]) -> None:
    """Pack the suspects of the open labs, and empty what is right of the statements: nothing of a lab reads that."""
    statements = out / _STATEMENTS
    statements.write_text(_ANSWER.sub(r'\1=""', statements.read_text(encoding="utf-8")), encoding="utf-8")
    for path in (out / _SUSPECTS / f"{topic}.py" for topic in open_labs):
        if path.is_file():
            path.write_text(_packed(path.read_text(encoding="utf-8")), encoding="utf-8")


def _packed(source: str) -> str:
    """A module that does the same and cannot be read in passing: wrong functions give most of the right ones away."""
    return f'"""Packed, so that nobody reads it in passing: find the input instead."""\n\n{_unpacking(source)}'


def _unpacking(source: str) -> str:
    """Lines that run a source which cannot be read in passing."""
    text = base64.b85encode(zlib.compress(source.encode("utf-8"))).decode("ascii")
    lines = "\n".join(f'    "{part}"' for part in textwrap.wrap(text, 100))
    return f"{_UNPACK}(\n{lines}\n)))\n"


def _ignored(folder: str, names: list[str]) -> set[str]:
    here = Path(folder).relative_to(ROOT).as_posix()
    return {
        name
        for name in names
        if name == "__pycache__" or name.startswith(".") or f"{here}/{name}" in _LEFT_OUT or name.endswith(".pyc")
    }


def _for_students(project: str) -> str:
    """The project's settings without the packages and the built files that a student's tree lacks."""
    return re.sub(r"(?ms)^packages = .*?^(?=\[tool\.ruff\])", 'packages = ["labs", "reference"]\n\n', project)


def _module(topic: str, names: Collection[str], asked: Collection[str]) -> str:
    """A module with these functions; those that contain a function which students still write are packed."""
    every, title = TopicExcerpts.of(topic), lecture.topic(topic).title
    packed = [name for name in names if any(found.defines & set(asked) for found in every.needed([name]))]
    plain = [name for name in names if name not in packed]
    texts = [_text(every, title, plain)] if plain else [f'"""{title}: given."""\n']
    if packed:
        texts.append(_unpacking(_text(every, title, packed)))
    return "\n\n".join(texts)


def _text(every: TopicExcerpts, title: str, names: Collection[str]) -> str:
    excerpts = every.needed(names)
    head = f'"""{title}: given."""\n\nfrom __future__ import annotations\n\n'
    return f"{head}{imports_of(excerpts)}\n\n{without_notes(text_of(excerpts))}\n"
