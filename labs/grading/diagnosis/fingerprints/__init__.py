"""What is known of the probes, kept as numbers: the right answers, and how far off each known mistake is on each.

`python -m labs.grading.diagnosis.fingerprints` makes the files anew from the solutions and the bank; `--check` says
what is stale.
They hold texts and numbers, no formula, so that a student's tree may carry them.
"""

from labs.grading.diagnosis.fingerprints.building import build, write
from labs.grading.diagnosis.fingerprints.checking import stale
from labs.grading.diagnosis.fingerprints.reading import Knowledge, Known, known

__all__ = ["Knowledge", "Known", "build", "known", "stale", "write"]
