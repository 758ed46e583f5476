"""Right answers with the symbols of the lecture: Greek letters, accents, names that are no English."""

import numpy as np

ε_nichts = 1e-12


def skalar(a, b):
    return np.einsum("...i,...i->...", a, b)


def point_velocity(v, ω, r):
    return v + np.cross(ω, r)


def relative_velocity(ṗ_A, ṗ_B):
    Δṗ = np.asarray(ṗ_A) - np.asarray(ṗ_B)
    return Δṗ


def normal_velocity(ṗ_A, ṗ_B, n):
    return skalar(relative_velocity(ṗ_A, ṗ_B), n)


def rebound_velocity(u, ε):
    u = np.asarray(u)
    return np.where(u < 0, -ε * u, u)


def classify_contact(u, η=0.0):
    größe = np.abs(u)
    return np.where(größe <= η, 0, np.sign(u))


def impulse_of_force(F, τ):
    Δτ = np.diff(τ)[..., None]
    F = np.asarray(F)
    return (Δτ * (F[..., :-1, :] + F[..., 1:, :]) / 2).sum(axis=-2)


def mean_force(ΔP, Δt, Σ=(0.0, 0.0, 0.0)):
    return np.asarray(ΔP) / np.asarray(Δt)[..., None] - np.asarray(Σ)


def point_plane_normal(ν, α, β):
    ν = ν / np.linalg.norm(ν, axis=-1, keepdims=True)
    σ = np.where(skalar(ν, np.asarray(α) - β) < 0, -1, 1)
    return σ[..., None] * ν


def edge_edge_normal(α, β, a, b):
    return point_plane_normal(np.cross(α, β), a, b)


def world_inverse_inertia(Θ, q):
    Θ, q = np.asarray(Θ, dtype=float), np.asarray(q, dtype=float)
    w, ξ = q[..., 0], q[..., 1:]
    Ξ = np.cross(ξ[..., None, :], np.eye(3)).swapaxes(-1, -2)
    R = np.eye(3) + 2 * w[..., None, None] * Ξ + 2 * Ξ @ Ξ
    Θ_inv = np.where(Θ > 0, 1 / np.where(Θ > 0, Θ, 1), 0)
    return R @ (Θ_inv[..., None] * R.swapaxes(-1, -2))


def κ(körper, n):
    _, _, r, μ, Θ = körper
    λ = np.cross(r, n)
    return μ + skalar(λ, np.matvec(Θ, λ))


def inverse_effective_mass(A, B, n):
    return κ(A, n) + κ(B, n)


def impulse_magnitude(A, B, n, ε):
    κ_AB, υ = inverse_effective_mass(A, B, n), normal_velocity(point_velocity(*A[:3]), point_velocity(*B[:3]), n)
    frei = κ_AB < ε_nichts
    return np.where(frei, 0.0, -(1 + np.asarray(ε)) * υ / np.where(frei, 1, κ_AB))


def contact_impulses(ι, n):
    J = np.asarray(ι)[..., None] * n
    return J, -J


def apply_impulse(A, B, J):
    def δ(körper, J):
        v, ω, r, μ, Θ = körper
        return v + np.asarray(μ)[..., None] * J, ω + np.matvec(Θ, np.cross(r, J))

    return δ(A, J) + δ(B, -np.asarray(J))


def apply_impulse_to_momenta(Π, Λ, r, J):
    return Π + np.asarray(J), Λ + np.cross(r, J)


def velocities_from_momenta(Π, Λ, μ, Θ):
    return np.asarray(μ)[..., None] * Π, np.matvec(Θ, Λ)


def collide(A, B, n, ε, η=0.0):
    υ = normal_velocity(point_velocity(*A[:3]), point_velocity(*B[:3]), n)
    ι = np.where(υ < -np.asarray(η), impulse_magnitude(A, B, n, ε), 0)
    return apply_impulse(A, B, contact_impulses(ι, n)[0])
