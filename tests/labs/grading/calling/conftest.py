"""What tests of calls share: a grader with room for all of them, and submissions that it runs."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterator

import pytest
from stand_ins import PATIENT

from labs.grading.calling.processes import Limits
from labs.grading.calling.remote import Grader, Remote
from labs.grading.submission.reading import Submission


@pytest.fixture(scope="session")
def grader() -> Iterator[Grader]:
    with Grader(PATIENT) as found:
        yield found


@pytest.fixture
def hasty(grader, monkeypatch) -> None:
    """Limits that are reached soon."""
    monkeypatch.setattr(grader, "limits", Limits(call=0.5, test=1.2, printed=50))


@pytest.fixture
def of(grader) -> Callable[[str], Remote]:
    """The submission of a text."""
    return lambda text: Remote(Submission("lab.py", textwrap.dedent(text)), grader)
