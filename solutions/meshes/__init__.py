"""Spring meshes: their parts, their motion, their rest (slide 28)."""

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
