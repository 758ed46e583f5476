"""Points, edges and polyhedra (slide 9).

These functions say whether a point is inside a polyhedron and which edges go
through which faces. They also find what is wrong with a mesh that has no clear
inside.
"""

from solutions.polyhedra.convex import (
    convex_separation,
    inside_convex,
)
from solutions.polyhedra.defects import MeshReport, mesh_report
from solutions.polyhedra.inside import (
    inside_by_parity,
    inside_by_winding,
    winding_number,
)
from solutions.polyhedra.intersection import (
    edges_through_faces,
    polyhedra_intersect,
)
from solutions.polyhedra.orientation import orient2d, orient3d, side_of_line
from solutions.polyhedra.segments import (
    segment_meets_triangle,
    segment_plane,
    segment_triangle,
)
from solutions.polyhedra.solid_angles import solid_angle
from solutions.polyhedra.surface import face_planes, mesh_edges, signed_volume

__all__ = [
    "MeshReport",
    "convex_separation",
    "edges_through_faces",
    "face_planes",
    "inside_by_parity",
    "inside_by_winding",
    "inside_convex",
    "mesh_edges",
    "mesh_report",
    "orient2d",
    "orient3d",
    "polyhedra_intersect",
    "segment_meets_triangle",
    "segment_plane",
    "segment_triangle",
    "side_of_line",
    "signed_volume",
    "solid_angle",
    "winding_number",
]
