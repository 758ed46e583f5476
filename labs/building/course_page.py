"""The page of the course: what depends on what, the hours of each lab, and courses of three labs, five and ten weeks.

`collisions lab build` writes it to `docs/course.md`. Hours and functions come from the lessons, so they are said once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from labs.building.instructor_page import parts
from labs.building.lessons import lessons, read
from reference import lecture

IDEAS: Mapping[str, tuple[str, str]] = {
    "detection": ("the dot product", "nothing"),
    "response": ("the dot product", "that a signed distance says which side of a plane a point is on (`detection`)"),
    "friction": (
        "forces in two directions; in step 6 the cross product and the moment of inertia",
        "what happens along the normal (`response`)",
    ),
    "impulse": ("the cross product, the moment of inertia", "the coefficient of restitution (`response`)"),
    "polyhedra": ("the cross product, arrays of indices", "which side of a plane a point is on (`detection`)"),
    "sweeping": (
        "quadratic equations, a little integration",
        "when a point meets a plane, and what a step misses (`detection`)",
    ),
    "forces": ("derivatives", "nothing"),
    "meshes": ("derivatives, matrices", "springs and their longest timestep (`forces`)"),
    "avoidance": ("the dot product, derivatives", "nothing"),
    "world": ("linear equations", "impulses (`impulse`) and friction (`friction`)"),
}
"""Of each lab, what it needs of mathematics, and which idea of an earlier lab it builds on."""
SPINE = ("detection", "response", "impulse")
"""The three labs that follow the lecture from its first slides on detection to the impulse of two rigid bodies."""
FIVE = ("detection", "response", "friction", "impulse", "world")
"""Five labs that end with a simulator: those that `world` builds on, and `world`."""


def page() -> str:
    """The page, in Markdown."""
    there = lessons()
    return _PAGE.format(
        labs=_table(there),
        minutes=_minutes(there),
        spine=_titles(SPINE),
        five=_titles(FIVE),
        spine_statements=_covered(SPINE),
        five_statements=_covered(FIVE),
        all_statements=len(lecture.STATEMENTS),
        only=_only(SPINE, there),
        only_five=_only(FIVE, there),
        later=_later([name for name in SPINE if name not in there]),
        later_of_five=_later([name for name in FIVE if name not in there]),
        first=SPINE[0],
    )


def _titles(names: Sequence[str]) -> str:
    return ", ".join(f"*{lecture.topic(name).title}* (`{name}`)" for name in names)


def _only(names: Sequence[str], there: Sequence[str]) -> str:
    return " ".join(f"--only {name}" for name in names if name in there)


def _covered(names: Sequence[str]) -> int:
    """How many statements of the lecture some labs cover."""
    return len({entry.statement for name in names for entry in lecture.functions_of(name)})


def _table(there: Sequence[str]) -> str:
    rows = [
        "| lab | hours | functions to write | [statements of the lecture](statements.md) | mathematics | builds on |",
        "|---|---|---|---|---|---|",
    ]
    for topic in lecture.TOPICS:
        needs, idea = IDEAS[topic.name]
        statements = sorted({entry.statement for entry in lecture.functions_of(topic.name)})
        hours, written = "planned", ""
        if topic.name in there:
            lesson = read(topic.name)
            hours = f"[{sum(part.minutes for part in parts(lesson)) / 60:.2g}](instructors/{topic.name}.md)"
            written = str(len(lesson.written))
        shown = ", ".join(map(str, statements))
        rows.append(f"| `{topic.name}` | {hours} | {written} | {shown} | {needs} | {idea} |")
    return "\n".join(rows)


def _minutes(there: Sequence[str]) -> str:
    rows = ["| lab | minutes of its parts |", "|---|---|"]
    for name in there:
        steps = "; ".join(f"{part.title}: {part.minutes}" for part in parts(read(name)) if part.minutes)
        rows.append(f"| `{name}` | {steps} |")
    return "\n".join(rows)


def _later(names: Sequence[str]) -> str:
    return f" ({' and '.join(f'`{name}`' for name in names)} can be named as soon as it exists)" if names else ""


_PAGE = """\
# The course

The lecture has ten topics, and each has a lab.

Every lab can be taken by itself: what a run needs from another lab is given. The last column of the table says which
idea a lab builds on, so that you know what to repeat if your class has not done the earlier lab. `collisions lab build`
writes this page from the lessons.

{labs}

The hours are planned and not timed; [how long a lab takes](notebooks.md#how-long-a-lab-takes) says how they were found.
Each number leads to the instructor's page of the lab, with the minutes of each part, what to discuss, the right
predictions, and the rubrics of the questions.

{minutes}

## Three labs

If you have three weeks, take the labs that lead from the first slides to the impulse between two rigid bodies:
{spine}. Each fills one session of two hours, with the first steps as homework before it and the questions as homework
after it.

```sh
collisions lab release --out week-1.zip {only} --through {first}
```

writes what the students get in the first week{later}. For
the next week, name the next lab in `--through`; the release then also has the answers of the labs before it.

## Five labs

If you have five weeks and an hour or two more, take the labs that lead to a simulator:
{five}. The last one puts the functions of the other
four together, and needs two sessions.

```sh
collisions lab release --out week-1.zip {only_five} --through {first}
```

begins this course{later_of_five}. The three labs cover {spine_statements} of the {all_statements} statements of the
lecture, and the five labs cover {five_statements}. If you would rather show more of the lecture than finish a
simulator, take any other two: `sweeping`, `polyhedra`, `forces` and `avoidance` need at most what `detection` teaches,
and `meshes` needs `forces`.

## Ten weeks

Take one lab a week, in the order of the table, which is that of the lecture. The last one, `world`, puts the others
together and takes two sessions of three hours: impacts in the first one, and rest in the second one. At its end
students have written a simulator from the lecture, and four projects lead on from there, each with a rubric.
`collisions lab release --out week-4.zip --through impulse` writes all labs up to one.

A session of two hours holds about the steps that the instructor's page of a lab calls *the lab*. Four labs need a
decision of yours:

- `polyhedra` has 170 minutes of such steps. Give its steps 6 and 7, 45 minutes, as homework: the robot and the lid,
  which come after them, do not need them.
- `response` has 130 minutes. Give its step 7 as homework.
- `avoidance` has 140 minutes. Leave out its step 5, or the flock.
- `friction` comes before `impulse`, and its step 6, the bowling ball, needs the cross product and the moment of
  inertia. If your class does not know them, come back to this step after `impulse`: step 7 does not need it.

## Handing out and marking

- Hand out an archive per week with `--through`, or all labs at once without it ([what a student
  gets](notebooks.md#what-a-student-gets)).
- Students work in the notebook; `collisions check` tells them what is right at any time.
- Mark the functions, the inputs and the predictions with `collisions lab marks`, and the questions by hand with the
  rubrics ([marking](grading.md#what-a-mark-is-made-of)).
- If you doubt whose work a file is, `collisions lab oral` makes three questions from it
  ([assistants](notebooks.md#ai-assistants)).
"""
