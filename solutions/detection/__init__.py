"""Detecting a collision with a plane (slides 2, 3, 4, 5 and 9).

These functions say where a point is, when it meets a plane, how often a puck
meets two walls, and what a step may miss.
"""

from solutions.detection.planes import (
    is_colliding,
    side_of_plane,
    signed_distance,
)
from solutions.detection.sampling import (
    missing_probability,
    overlap_interval,
)
from solutions.detection.time_of_impact import (
    time_of_impact_exact,
    time_of_impact_interpolated,
)
from solutions.detection.two_walls import count_impacts

__all__ = [
    "count_impacts",
    "is_colliding",
    "missing_probability",
    "overlap_interval",
    "side_of_plane",
    "signed_distance",
    "time_of_impact_exact",
    "time_of_impact_interpolated",
]
