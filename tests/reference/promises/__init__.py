"""What every engine promises, whatever it is and whatever it runs.

Each promise is a plain function: its name is the statement, and it raises where a run breaks it. At the end of each
module a table says which runs of the grid each of its promises concerns; without a word it is all of them.
"""

from . import contacts, flight, scenarios, settings, trajectories
from .run import Promise, Run, broken, run_of

PROMISES: tuple[Promise, ...] = (
    *trajectories.PROMISES,
    *settings.PROMISES,
    *flight.PROMISES,
    *contacts.PROMISES,
    *scenarios.PROMISES,
)

__all__ = ["PROMISES", "Promise", "Run", "broken", "run_of"]
