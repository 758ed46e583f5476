"""Contents of `grade.json` that nobody earned: a right, a wrong and a suspect function, with hostile words in them."""

from __future__ import annotations

from typing import Any

HOSTILE = (
    "<script>alert(1)</script> $\\href{javascript:1}{a}$ ``` `x` | # =1+1 \x1b[31m \u202e ::error:: [a](http://b)\n- c"
)
"""Words that a student could put into a message, a name or the name of a file."""
HIDDEN_TITLE = "any two bodies"


def outcome(function: str, title: str, got: int, possible: int, hidden: bool = False, said: str = "") -> dict[str, Any]:
    """A test of a function with one part for each point, of which the first ones passed."""
    parts = [
        {"reason": f"case {place}", "got": int(place < got), "possible": 1, "message": "" if place < got else said}
        for place in range(possible)
    ]
    return {
        "name": f"test_{title.replace(' ', '_')}", "title": title, "function": function, "topic": "impulse",
        "hidden": hidden, "passed": got == possible, "got": got, "possible": possible, "message": "",
        "rationale": "Momentum is kept: m_A v_A + m_B v_B.", "help": "Slide 20 *and* 21.", "parts": parts,
    }  # fmt: skip


def function(name: str, got: int, possible: int, verdict: str, message: str = "", *known: str) -> dict[str, Any]:
    """What is said of a function."""
    return {
        "name": name, "topic": "impulse", "got": got, "possible": possible, "verdict": verdict, "suspect": False,
        "mend_first": [], "mistakes": list(known), "message": message,
    }  # fmt: skip


def grade(file: str = "impulse.ipynb", said: str = HOSTILE) -> dict[str, Any]:
    """A grade of nine of fifteen points of the tests, two of three inputs, and all of four predictions."""
    return {
        "schema": "collisions-lab/grade", "version": 1,
        "identity": {
            "student": "4711", "name": "=Ada", "lab": "impulse", "entry": "ada", "file": file, "sha256": "0" * 64,
            "release": "", "seconds": 60.0, "versions": {"python": "3.11.7"},
        },
        "submission": file, "tier": "files and network sealed", "missing": [], "left_out": {}, "complaints": [said],
        "got": 9, "possible": 15,
        "functions": [
            function("collide", 3, 6, "named", f"collide: the order is wrong.\n  {said}", "reversed-order"),
            function("audit", 6, 6, "right"),
            function("apply_impulse", 0, 3, "crashes", said),
        ],
        "tests": [
            outcome("collide", "a collision keeps momentum", 1, 3, said=said),
            outcome("collide", HIDDEN_TITLE, 2, 3, hidden=True, said="the answer is wrong"),
            outcome("audit", "what is lost", 6, 6),
            outcome("apply_impulse", "limiting cases", 0, 3, hidden=True, said="the function raised an exception"),
        ],
        "marks": {
            "functions": {"reached": 9, "possible": 15}, "written questions": {"reached": None, "possible": 19},
            "inputs found": {"reached": 2, "possible": 3}, "predictions made": {"reached": 4, "possible": 4},
        },
        "points": 45 * 9 / 15 + 10 + 5, "answers": {},
    }  # fmt: skip


def unreadable(why: str = HOSTILE) -> dict[str, Any]:
    """The grade of a file that cannot be read."""
    return {
        "schema": "collisions-lab/grade", "version": 1, "unreadable": why, "marks": {}, "points": 0.0,
        "identity": {**grade()["identity"], "file": HOSTILE},
    }  # fmt: skip
