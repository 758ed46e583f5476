"""What is known of the probes, kept as numbers: the right answers, and the deviation of each known mistake on each.

`python -m labs.grading.diagnosis.fingerprints` makes the files again from the solutions and the bank of mistakes;
`--check` says what is stale. They hold texts and numbers and no formula, so a student's tree may carry them.
"""

from labs.grading.diagnosis.fingerprints.building import build, write
from labs.grading.diagnosis.fingerprints.reading import Knowledge, Known, known
from labs.grading.diagnosis.fingerprints.staleness import stale

__all__ = ["Knowledge", "Known", "build", "known", "stale", "write"]
