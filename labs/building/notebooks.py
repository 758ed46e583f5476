"""Makes two notebooks from a lesson: the student's, with stubs, and the solved one, with the solutions' own text.

Both carry nbgrader's metadata, so that a JupyterHub can collect and grade them. A function's cell is tagged with the
function's name, which our own grader looks for. The same lesson and solutions always make the same bytes.
"""

from __future__ import annotations

import ast
import json
import textwrap
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from labs.building.lessons import Cell, Lesson, lessons, read
from labs.building.points import points_of
from labs.building.revealed_answers import answers_of, compact
from labs.building.seeded_questions import as_python
from labs.grading.submission.excerpts import Excerpt, TopicExcerpts, imports_of, text_of, without_notes
from labs.grading.submission.reading import DRAFT
from labs.grading.submission.stubs import AGAIN, VERSION
from reference import lecture
from reference.errors import InvalidInput

WIDTH = 79
"""Characters of a line of code that a notebook shows whole where it is 800 pixels wide."""
YOURS = "is yours to write"
_ORDINALS = ("first", "second", "third")
_LEAST = 24
"""A line of a solution with at least so many characters gives something away; shorter ones occur in any text."""
_SETUP = """\
# @title Run this cell first, and after every restart
from __future__ import annotations

import sys
from pathlib import Path

here = Path.cwd()


def find_lab():
    places = [here, *here.parents, *here.glob("*/")]
    return [x for x in places if (x / "labs" / "notebook.py").is_file()]


if "google.colab" in sys.modules:
    # Colab asks for the course's files, once for every machine that it lends.
    import io, zipfile
    from google.colab import files

    if not find_lab():
        print("Choose the archive that you were given, a .zip file.")
{earlier}        for content in files.upload().values():
            if zipfile.is_zipfile(io.BytesIO(content)):
                zipfile.ZipFile(io.BytesIO(content)).extractall()
    if not find_lab():
        raise FileNotFoundError("no archive of the lab: run this cell again")
    bullet = find_lab()[0] / "bullet.txt"
    !pip install --quiet "mujoco>=3.12,<5" "hypothesis>=6.100" "pytest>=8.4"
    !pip install --quiet --no-deps --require-hashes -r "{bullet}"
    !pip install --quiet "dartpy>=6.20,<7"

for folder in find_lab()[:1]:
    sys.path.insert(0, str(folder))

# If there is no module labs, put this notebook back where it came from.
from labs import lab

lab.begin("{topic}")"""
_EARLIER = """\
        print("With it you may choose {notebooks},")
        print("so that runs take your own functions from there.")
"""
_SETUP_ABOVE = """\
**Run the folded cell below first**, and again after every restart. It finds the lab and says which engines run here."""
_ANSWER = "*Your answer:* "
_KERNEL = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}


@dataclass
class _Draft:
    """A notebook that is being made. taken: the excerpts that it holds already. cells: as nbformat has them."""

    lesson: Lesson
    excerpts: TopicExcerpts
    taken: list[Excerpt] = field(default_factory=list)
    cells: list[dict[str, Any]] = field(default_factory=list)

    def add(self, kind: str, source: str, **metadata: Any) -> None:
        """Add a cell; its id says where it is in the notebook."""
        cell: dict[str, Any] = {
            "cell_type": kind,
            "id": f"{self.lesson.topic}-{len(self.cells):02}",
            "metadata": metadata,
            "source": source.splitlines(keepends=True),
        }
        self.cells.append(cell | ({"execution_count": None, "outputs": []} if kind == "code" else {}))

    def take(self, names: Iterable[str]) -> list[Excerpt]:
        """Return the excerpts that names need and that the notebook lacks; from now on it counts as holding them."""
        found = self.excerpts.needed(tuple(names), self.taken)
        self.taken += found
        return found


def student(topic: str) -> dict[str, Any]:
    """The notebook that a student opens.

    Raises
    ------
    InvalidInput
        If a given function needs, or the notebook shows, the solution of a function that the student writes.
    """
    lesson = read(topic)
    draft = _Draft(lesson, TopicExcerpts.of(topic))
    versions = Counter[Sequence[str]]()
    for cell in lesson.cells:
        if cell.kind == "write":
            for name in cell.names:
                _function(draft, name, stub(draft.excerpts, name, again=name in lesson.drafts))
        elif cell.kind == "draft":
            _first_version(draft, cell, draft_stub(lesson.topic, cell, versions[cell.names]))
            versions[cell.names] += 1
        elif cell.kind not in ("model", "instructor"):
            _common(draft, cell)
            if cell.kind == "answer":
                draft.add("markdown", _ANSWER, **_answer(cell))
    made = _notebook(draft)
    _refuse_solutions(draft, made)
    return made


def solved(topic: str) -> dict[str, Any]:
    """The instructor's notebook, with solutions, model answers and the notes for the instructor."""
    lesson = read(topic)
    draft = _Draft(lesson, TopicExcerpts.of(topic))
    drafts = {name: iter(lesson.models(f"{DRAFT}{name}")) for name in lesson.drafts}
    for cell in lesson.cells:
        if cell.kind == "write":
            for name in cell.names:
                _function(draft, name, _silent(text_of(draft.take([name]))))
        elif cell.kind == "draft":
            _first_version(draft, cell, next(drafts[cell.names[0]]).text)
        elif cell.kind == "broken":
            for model in lesson.models(cell.key):
                draft.add("code" if model.code else "markdown", model.text)
        elif cell.kind == "instructor":
            draft.add("markdown", _framed("For the instructor", cell.text))
        elif cell.kind != "model":
            _common(draft, replace(cell, text=cell.guessed))
            for model in lesson.models(cell.key) if cell.kind == "answer" else ():
                draft.add(
                    "markdown", _framed("A good answer, and how it is marked", as_python(model.text)), **_answer(cell)
                )
    return _notebook(draft)


def text(notebook: dict[str, Any]) -> str:
    """A notebook as its file holds it."""
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


def stub(excerpts: TopicExcerpts, name: str, again: bool = False) -> str:
    """A function as a student finds it: its header, its contract, and an error that says whose turn it is.

    The contract is the docstring without its *Notes*, which say how the function is found. again: whether the student
    has written a first version of it.

    Raises
    ------
    InvalidInput
        If the contract holds a line that the student is to derive.
    """
    source = excerpts.defining(name).text
    function = next(node for node in ast.parse(source).body if isinstance(node, ast.FunctionDef))
    entry, description = lecture.function(name), function.body[0]
    lines = source.split("\n")[description.lineno - 1 : description.end_lineno]
    contract = without_notes("\n".join([*_header(function), *lines]))
    _refuse_answers(entry.topic, name, contract)
    return "\n".join([contract, *_unwritten(f"{entry.topic}, step {entry.step}: {name} {AGAIN if again else YOURS}")])


def _header(function: ast.FunctionDef) -> list[str]:
    """The header of a function without its types: in one line where that fits, else each argument in a line."""
    given = function.args
    names = [argument.arg for argument in given.args]
    first = len(names) - len(given.defaults)
    each = names[:first] + [f"{name}={ast.unparse(it)}" for name, it in zip(names[first:], given.defaults, strict=True)]
    whole = f"def {function.name}({', '.join(each)}):"
    return [whole] if len(whole) <= WIDTH else [f"def {function.name}(", *(f"    {one}," for one in each), "):"]


def draft_stub(topic: str, cell: Cell, before: int) -> str:
    """A version of a function as a student finds it: what the lesson says of it, and an error.

    before: how many versions for still simpler cases come before it.
    """
    (name,) = cell.names
    _refuse_answers(topic, name, cell.text)
    return "\n".join([cell.text, *_unwritten(f"{topic}: a {_ORDINALS[before]}{VERSION}{name} {YOURS}")])


def _refuse_answers(topic: str, name: str, contract: str) -> None:
    """Raise if a contract holds a line that the student is to derive."""
    text = compact(contract)
    for answer in answers_of(topic, name):
        if answer in text:
            raise InvalidInput(f"the stub of {name} holds a line that is to be derived: {answer}")


def _unwritten(said: str) -> list[str]:
    """The lines of an error that says whose turn it is."""
    whole = f'    raise NotImplementedError("{said}")'
    return [whole] if len(whole) <= WIDTH else ["    raise NotImplementedError(", f'        "{said}"', "    )"]


def _first_version(draft: _Draft, cell: Cell, source: str) -> None:
    """The cell of a first version. It has no check: the runs after it show what it can do."""
    (name,) = cell.names
    draft.add("code", source, tags=[f"{DRAFT}{name}"])


def _common(draft: _Draft, cell: Cell) -> None:
    """A cell that is the same in both notebooks."""
    if cell.kind == "lab":
        draft.add("markdown", _SETUP_ABOVE)
        folded = {"jupyter": {"source_hidden": True}, "cellView": "form"}  # in Jupyter, and on Colab
        draft.add("code", _setup(draft.lesson), tags=["setup"], **folded)
    elif cell.kind == "given":
        source = _given(draft, cell)
        if not source:  # a solution above, which the student writes without it, has brought it along
            return
        draft.add("code", source, tags=["given"], jupyter={"source_hidden": True})
    else:
        draft.add("code" if cell.code else "markdown", cell.text)


def _setup(lesson: Lesson) -> str:
    """The first cell. It asks for notebooks of earlier labs if the runs call functions that students wrote there."""
    topics = [topic.name for topic in lecture.TOPICS]
    lent = {entry.topic for entry in map(lecture.function, lesson.lent) if entry.role == "written"}
    earlier = [name for name in topics[: topics.index(lesson.topic)] if name in lent and name in lessons()]
    asked = _EARLIER.replace("{notebooks}", ", ".join(f"{name}.ipynb" for name in earlier)) if earlier else ""
    return _SETUP.replace("{earlier}", asked).replace("{topic}", lesson.topic)


def _given(draft: _Draft, cell: Cell) -> str:
    """The functions that a cell gives; nothing if the notebook holds them already."""
    first = "" if draft.taken else "from __future__ import annotations\n\n" + imports_of(draft.excerpts.every) + "\n\n"
    found = draft.take(cell.names)
    written = {name for name, entry in lecture.FUNCTIONS.items() if entry.role == "written"}
    shown = {name for excerpt in found for name in excerpt.defines} & {*draft.lesson.written, *written}
    if shown:
        gives, needs = " ".join(cell.names), ", ".join(sorted(shown))
        raise InvalidInput(f"the lesson of {draft.lesson.topic} gives {gives}, which needs {needs}")
    if not found:
        return ""
    title = cell.text.lstrip("# ") or "Given: run it, and read what you like."
    return f"# {title}\n{first}{_silent(text_of(found))}"


def _silent(text: str) -> str:
    """A cell's text that prints nothing: a description of a value in its last line would be shown as its result."""
    return f"{text};" if text.endswith('"""') else text


def _function(draft: _Draft, name: str, source: str) -> None:
    """A function's cell and the one that checks it."""
    draft.add("code", source, tags=[name], nbgrader=_nbgrader(name, solution=True))
    grading = _nbgrader(f"check-{name}", grade=True, locked=True, points=points_of(name))
    draft.add("code", f'lab.check("{name}")', tags=["check"], editable=False, deletable=False, nbgrader=grading)


def _answer(cell: Cell) -> dict[str, Any]:
    return {"nbgrader": _nbgrader(f"answer-{cell.key}", grade=True, solution=True, points=cell.points)}


def _nbgrader(name: str, **kind: Any) -> dict[str, Any]:
    plain = {"schema_version": 3, "grade_id": name, "grade": False, "solution": False, "locked": False, "task": False}
    return {**plain, **kind}


def _framed(title: str, text: str) -> str:
    return f"**{title}**\n\n{text}"


def _notebook(draft: _Draft) -> dict[str, Any]:
    return {"cells": draft.cells, "metadata": _KERNEL, "nbformat": 4, "nbformat_minor": 5}


def _refuse_solutions(draft: _Draft, made: dict[str, Any]) -> None:
    """Raise if the student's notebook holds a line of a solution that the student is to write.

    A line that a given function has as well reveals nothing.
    """
    text, given = "\n".join("".join(cell["source"]) for cell in made["cells"]), text_of(draft.taken)
    for excerpt in draft.excerpts.needed(draft.lesson.written, draft.taken):
        for line in _revealing_lines(excerpt):
            if line in text and line not in given:
                raise InvalidInput(f"the student's notebook of {draft.lesson.topic} holds a solution's line: {line}")


def _revealing_lines(excerpt: Excerpt) -> Iterator[str]:
    """The lines of an excerpt's functions that say how it is done: neither signature nor description."""
    for function in ast.walk(ast.parse(excerpt.text)):
        if isinstance(function, ast.FunctionDef):
            body = function.body[bool(ast.get_docstring(function)) :]
            for line in excerpt.text.split("\n")[body[0].lineno - 1 : function.end_lineno]:
                if len(line.strip()) >= _LEAST:
                    yield textwrap.dedent(line).strip()
