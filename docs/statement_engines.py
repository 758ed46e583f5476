"""Which scenarios put a statement of the lecture to the test, and what each implementation's results are.

`make verdicts` runs the hand-written code, which takes two minutes, and reads what the engines were recorded with. It
keeps the count of verdicts in docs/statement_verdicts.json, which is in git; `statement_table.py` makes columns of it.
"""

from __future__ import annotations

import functools
import json
from collections import Counter
from pathlib import Path

from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.engines.profiles import counts
from reference.errors import CollisionsError
from reference.recording.reading import recall
from reference.report.marks import LEGEND, MARKS, SEVERITY
from reference.running.study import run_job

KEPT = Path(__file__).with_name("statement_verdicts.json")
IMPLEMENTATIONS = ("handwritten", "pybullet", "mujoco", "dart")
Found = dict[str, dict[str, dict[str, int]]]
"""By family and implementation, how many numbers got each verdict."""


def collect() -> Found:
    """What every family gave in every implementation, in the profile that counts first."""
    return {
        family: {name: dict(sorted(_verdicts(family, name).items())) for name in IMPLEMENTATIONS}
        for family in catalogue()
    }


def _verdicts(family: str, name: str) -> Counter[str]:
    engine = load_engine(name)
    profile = next(filter(counts, catalogue()[family].profiles(engine)))
    cases = catalogue()[family].cases_in(engine, profile)  # those of a report
    job = Job(family, name, profile, tuple(case.name for case in cases))
    result: JobResult | None = recall(job) if engine.package else run_job(job)
    if result is None:
        raise CollisionsError(f"{family} is not recorded in {engine.title}; collisions record {family} does it")
    return Counter(row.verdict.value for row in result.rows)


@functools.cache
def kept() -> Found:
    """What was collected last."""
    found: Found = json.loads(KEPT.read_text(encoding="utf-8"))
    return found


def families(statement: int) -> list[str]:
    """The families that put a statement to the test, in the order of teaching."""
    return [family.name for family in catalogue().values() if statement in family.statements]


def title(name: str) -> str:
    """The heading of an implementation's column."""
    return load_engine(name).title


def cell(statement: int, name: str) -> str:
    """How many families an implementation passes, by the mark of the worst number that it can express in each."""
    marks = Counter(_worst(kept()[family][name]) for family in families(statement))
    return " ".join(f"{MARKS[verdict]} {marks[verdict]}" for verdict in _mildest_first(marks))


def numbers(family: str, name: str) -> str:
    """How many numbers of a family got each verdict in an implementation."""
    found = {Verdict(verdict): count for verdict, count in kept()[family][name].items()}
    return " ".join(f"{MARKS[verdict]} {found[verdict]}" for verdict in _mildest_first(found))


def legend() -> list[str]:
    """What each mark that occurs means."""
    occurring = {Verdict(verdict) for engines in kept().values() for found in engines.values() for verdict in found}
    return [
        f"{MARKS[verdict]} {LEGEND[verdict].split(';')[0]}" for verdict in _mildest_first(dict.fromkeys(occurring, 1))
    ]


def _worst(found: dict[str, int]) -> Verdict:
    """Of the numbers that there are; what an engine cannot express counts where there is nothing else."""
    verdicts = [Verdict(verdict) for verdict in found]
    given = [each for each in verdicts if each is not Verdict.CANNOT_EXPRESS and each is not Verdict.SHOWN]
    return min(given or verdicts, key=SEVERITY.index)


def _mildest_first(found: Counter[Verdict] | dict[Verdict, int]) -> list[Verdict]:
    return sorted(found, key=SEVERITY.index, reverse=True)


def main() -> None:
    """Collect, and keep."""
    KEPT.write_text(json.dumps(collect(), indent=1) + "\n", encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
