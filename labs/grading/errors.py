"""What can go wrong with a submission: a student may read each error, and it costs one test but never the grader."""

from __future__ import annotations

from reference.errors import CollisionsError, NeedsFunction, WorkerCrashed


class UnreadableSubmission(CollisionsError):
    """The file holds no submission at all: it is missing, empty, too large or of another kind, as the message says."""

    exit_code = 2


class StudentError(CollisionsError):
    """What the submission's code did instead of answering, or besides; the message is fit to be shown to the student.

    gist: the same in our own words only, for the feedback of a hidden test. A submission could smuggle a hidden test's
    inputs out in a message or in the name of a type.
    """

    gist = "gave no answer"


class FunctionMissing(StudentError, NeedsFunction):
    """The function is not in the submission, or still raises NotImplementedError."""

    gist = "is not written yet"


class FunctionRaised(StudentError):
    """The function raised an exception.

    kind: the exception's type. line: of the submission's text, counted from 1, or None where it is not known. through:
    the submission's functions that it passed through, as the submission's own process names them.
    """

    gist = "raised an exception"

    def __init__(self, message: str, kind: str = "", line: int | None = None, through: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.kind, self.line, self.through = kind, line, through


class WrongType(StudentError):
    """The function gave an object that is no answer: it is no number, text, array or tuple of these."""

    gist = "gave an object that is no answer"


class OutOfTime(StudentError):
    """A call, or all calls of a test together, exceeded the time limit; the process was stopped."""

    gist = "took too long"


class NotTried(OutOfTime):
    """The time of the whole submission was used up before this call; it says nothing about the function."""

    gist = "was not tried, because the time for the whole file was used up"


class ProcessDied(StudentError):
    """The process ended before it answered: a crash, os._exit, or a limit that the system enforces."""

    gist = "ended its process"


class NoAnswer(StudentError):
    """The bytes that came back are not a message of the worker: they are too long, or it did not write them."""


class ArgumentsChanged(StudentError):
    """The function wrote into its arguments, whatever it returned."""

    gist = "writes into its arguments, as a += b and a[0] = b do: the caller's own arrays change"


class NotSteady(StudentError):
    """The same call in a fresh process gave another answer."""

    gist = "answered the same call in two ways"


class GraderFailed(WorkerCrashed):
    """The grader's own processes do not work on this machine, or offer less protection than was requested."""


class MachineBusy(GraderFailed):
    """Other programs had the processors for so long that the submission could not be graded; this is not its fault."""

    def __init__(self, message: str = "") -> None:  # a message where another process has raised it
        why = "not graded for lack of time: the machine was too busy with other programs. Grade again when it is idle"
        super().__init__(message or why)
