"""Detecting a collision with a plane (slides 2, 3, 4, 5 and 9).

- `overlap_interval`: when within a step a ball overlaps a slab (slide 2)
- `count_impacts`: how often a puck hits two walls (slide 3)
- `signed_distance`: how far a point is in front of a plane (slide 4)
- `side_of_plane`: in front of the plane, on it, or behind it (slide 4)
- `is_colliding`: whether a point is behind the plane (slide 4)
- `time_of_impact_interpolated`: when, along a straight line (slide 5)
- `time_of_impact_exact`: when, at a constant acceleration (slide 5)
- `missing_probability`: the share that a test at each step misses (slide 9)
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
