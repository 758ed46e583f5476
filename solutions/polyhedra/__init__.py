"""Points, edges and polyhedra (slide 9).

A mesh, and what is wrong with it:

- `face_planes`: the plane n·p + d = 0 of every face
- `mesh_edges`: every edge once
- `signed_volume`: the volume, negative where the faces look inwards
- `mesh_report`: all that keeps a mesh from having a clear inside

On which side a point is:

- `side_of_line`: left of a line, on it, or right of it, in floats
- `orient2d`: the same, exactly
- `orient3d`: in front of a face, in its plane, or behind it, exactly

Whether a point is inside:

- `convex_separation`: how far it is in front of a convex solid
- `inside_convex`: whether it is in front of no face
- `inside_by_parity`: whether a ray crosses an odd number of faces
- `solid_angle`: of a triangle as seen from the point
- `winding_number`: how often the surface goes round the point
- `inside_by_winding`: whether it does more than half a time

Where an edge goes through a face:

- `segment_plane`: the share of a segment at which it meets a plane
- `segment_triangle`: where on a segment and a triangle the two meet
- `segment_meets_triangle`: whether they do, exactly
- `edges_through_faces`: all edges of A that meet a face of B
- `polyhedra_intersect`: whether two solids have a point in common
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
