"""Spring meshes: their parts, their motion, their rest (slide 28).

A mesh
- `SpringMesh`: nodes with masses, and springs and dampers between them
- `spring_mesh`: a mesh that is at rest in a given shape
- `pin`: the same mesh with some nodes pinned
- `cloth`: the nodes and edges of a cloth
- `lattice`: the nodes and edges of a solid

Its forces and its motion
- `mesh_forces`: the force of springs and dampers on every node
- `edge_directions`: how the springs lie, and how long they are
- `edge_strain`: how much each spring is stretched
- `mesh_energy`: the energy that the springs store
- `mesh_step`: a step of semi-implicit Euler
- `mesh_sphere_contact`: the contact of the nodes with a fixed sphere
- `limit_strain`: positions in which no spring is too long
- `static_shape`: the shape at rest

The internal springs that keep a shape, and the steps that springs permit
- `diagonals`: which of some springs are needed, as few as possible
- `zero_energy_modes`: how many motions no spring resists
- `timestep_bound`: a step that is safe in every shape
- `stable_timestep`: the longest stable step in one shape
- `largest_eigenvalue`: the square of the highest frequency

A step without a limit
- `implicit_mesh_step`: a step of backward Euler
- `conjugate_gradient`: the solution of its linear system
- `edge_stiffness`: the matrix of every spring
- `edge_damping`: the matrix of every damper
- `mesh_product`: the matrix of the whole mesh times a vector
- `mesh_matrix`: this matrix itself
"""

from solutions.meshes.bracing import diagonals
from solutions.meshes.conjugate_gradients import conjugate_gradient
from solutions.meshes.contact import mesh_sphere_contact
from solutions.meshes.grids import cloth, lattice
from solutions.meshes.matrices import (
    edge_damping,
    edge_stiffness,
    mesh_matrix,
    mesh_product,
)
from solutions.meshes.mesh import SpringMesh, pin, spring_mesh
from solutions.meshes.shape import limit_strain, static_shape
from solutions.meshes.springs import (
    edge_directions,
    edge_strain,
    mesh_energy,
    mesh_forces,
)
from solutions.meshes.stability import (
    largest_eigenvalue,
    stable_timestep,
    timestep_bound,
    zero_energy_modes,
)
from solutions.meshes.steps import (
    implicit_mesh_step,
    mesh_step,
)

__all__ = [
    "SpringMesh",
    "cloth",
    "conjugate_gradient",
    "diagonals",
    "edge_damping",
    "edge_directions",
    "edge_stiffness",
    "edge_strain",
    "implicit_mesh_step",
    "largest_eigenvalue",
    "lattice",
    "limit_strain",
    "mesh_energy",
    "mesh_forces",
    "mesh_matrix",
    "mesh_product",
    "mesh_sphere_contact",
    "mesh_step",
    "pin",
    "spring_mesh",
    "stable_timestep",
    "static_shape",
    "timestep_bound",
    "zero_energy_modes",
]
