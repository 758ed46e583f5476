"""What the runs of the catalogue may cost: processor seconds for each family in each engine, all profiles together.

A live report of everything should take six minutes on two idle cores: its runs of some two hundred pairs of a family
and an engine, and its pages, have 720 s of processor. Seconds are those of the machine of the allowances
(`reference.pace`).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from reference.comparison.results import JobResult

SECONDS = 10.0
"""For a family in an engine that is not named below. Most need less than 3 s, with their studies; slabs on 25 slopes by
hand, and orbits by five methods, 9 s."""
MORE = {
    ("ball-to-rest", "dart"): 14.0,  # up to 14 s of motion in steps of 0.1 ms, and more of them in the study
    ("ball-to-rest", "pybullet"): 12.0,  # the same with a contact spring, which needs steps of 0.05 ms
    ("stack", "handwritten"): 15.0,  # ten boxes and five for 10 s, with all their contacts
    ("stack", "pybullet"): 20.0,  # the same in steps of 1 ms, and of half as much in the study
    ("stack", "dart"): 30.0,  # the same; a step takes half as long again as PyBullet's
}
"""Those that may take longer, and why."""
NOISE = 2.0
"""A run takes up to half as long again beside others on the same processors; only beyond twice is something wrong."""


def too_long(results: Iterable[JobResult], slowness: float) -> dict[tuple[str, str], float]:
    """Families and engines that took longer than twice their allowance, and how long, s.

    results: of the jobs of a report. slowness: of the machine.
    """
    took: Counter[tuple[str, str]] = Counter()
    for result in results:
        took[result.job.family, result.job.engine] += result.processor_seconds / slowness
    return {pair: seconds for pair, seconds in took.items() if seconds > NOISE * MORE.get(pair, SECONDS)}
