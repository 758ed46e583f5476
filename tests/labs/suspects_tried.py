"""For each suspect: the mistake of the bank that it makes, an input that exposes it, and one that does not."""

from __future__ import annotations

BANK_ENTRY = {
    ("detection", "distance"): "signed_distance/offset not over the length",
    ("detection", "hail"): "time_of_impact_exact/never when rising",
    ("detection", "gallery"): "overlap_interval/from the front alone",
    ("impulse", "crates"): "edge_edge_normal/as they run",
    ("impulse", "hammer"): "inverse_effective_mass/only A turns",
    ("impulse", "aircraft"): "world_inverse_inertia/turned the other way",
    ("response", "trampoline"): "penalty_force/dashpot at a distance",
    ("response", "film"): "respond_at_impact/rest of the step lost",
    ("friction", "carts"): "friction_force/against the push while sliding",
    ("friction", "scales"): "support_force/never lifts off",
    ("friction", "track"): "clamp_to_circle/each component alone",
    ("polyhedra", "crates"): "convex_separation/nearest plane",
    ("polyhedra", "statue"): "winding_number/unsigned angles, cut at one",
    ("polyhedra", "garden"): "inside_by_parity/border left out",
}
TETRAHEDRON = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
EXPOSING = {
    ("detection", "distance"): ([0.0, 0.0, 3.0], [0.0, 0.0, 2.0], 4.0),
    ("detection", "hail"): (0.5, 2.0, -10.0),
    ("detection", "gallery"): (-0.5, 2.0, 0.1, 0.1, 1.0),
    ("impulse", "crates"): ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [0.0, 0.0, 0.0]),
    ("impulse", "hammer"): (
        ([0, 0, -1], [0, 0, 0], [0, 0, 0], 1.0, [[1, 0, 0], [0, 1, 0], [0, 0, 1]]),
        ([0, 0, 0], [0, 0, 0], [0.5, 0, 0], 1.0, [[1, 0, 0], [0, 1, 0], [0, 0, 1]]),
        [0, 0, 1],
    ),
    ("impulse", "aircraft"): ([1.0, 2.0, 4.0], [0.8, 0.4, 0.4, 0.2]),
    ("response", "flipper"): ([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], 0.5, [0.0, 0.0, 3.0]),
    ("response", "trampoline"): (0.1, -2.0, [0.0, 0.0, 1.0], 1000.0, 100.0),
    ("response", "film"): ([0, 0, 1], [0, 0, -2], [0, 0, 0], [0, 0, 1], 0.5, 0.5, 1.0),
    ("friction", "carts"): ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 10.0, 0.5, 0.3),
    ("friction", "scales"): (1.0, [0, 0, -10], [0, 0, 20], [0, 0, 0], [0, 0, 1]),
    ("friction", "track"): ([3.0, 4.0, 0.0], 4.0),
    ("polyhedra", "crates"): ([2.0, 0.1, 0.1], *TETRAHEDRON),
    ("polyhedra", "statue"): ([2.0, 1.0, 1.0], *TETRAHEDRON),
    ("polyhedra", "garden"): ([-0.5, -0.5, 0.1], [[-1, -1, 0], [2, -1, 0], [-1, 2, 0], [0, 0, 1]], TETRAHEDRON[1]),
}
HARMLESS = {
    ("detection", "distance"): ([1.0, 2.0, 3.0], [0.0, 0.0, 2.0], 0.0),
    ("detection", "hail"): (0.5, -2.0, -10.0),
    ("detection", "gallery"): (0.5, -2.0, 0.1, 0.1, 1.0),
    ("impulse", "crates"): ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
    ("impulse", "hammer"): (EXPOSING["impulse", "hammer"][1], EXPOSING["impulse", "hammer"][0], [0, 0, 1]),
    ("impulse", "aircraft"): ([1.0, 2.0, 4.0], [1.0, 0.0, 0.0, 0.0]),
    ("response", "flipper"): ([0.4, 0.0, -1.0], [0.0, 0.0, 1.0], 0.5, [0.0, 0.0, 3.0]),
    ("response", "trampoline"): (-0.1, -2.0, [0.0, 0.0, 1.0], 1000.0, 100.0),
    ("response", "film"): ([0, 0, 1], [0, 0, -2], [0, 0, 0], [0, 0, 1], 0.5, 1.0, 1.0),
    ("friction", "carts"): ([1.0, 0.0, 0.0], [0.0, 0.0, 0.0], 10.0, 0.5, 0.3),
    ("friction", "scales"): (1.0, [0, 0, -10], [0, 3, 4], [0, 0, 0], [0, 0, 1]),
    ("friction", "track"): ([3.0, 4.0, 0.0], 5.0),
    ("polyhedra", "crates"): ([0.2, 0.1, 0.15], *TETRAHEDRON),
    ("polyhedra", "statue"): ([0.2, 0.1, 0.15], *TETRAHEDRON),
    ("polyhedra", "garden"): ([0.2, 0.1, 0.15], *TETRAHEDRON),
}
