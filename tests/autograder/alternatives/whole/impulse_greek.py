"""Right answers with the symbols of the lecture: Greek letters, accents, names that are no English."""

import numpy as np

ε_nichts = 1e-12


def skalar(a, b):
    return np.einsum("...i,...i->...", a, b)


def ṗ(v, ω, r):
    return v + np.cross(ω, r)


def normal_velocity(A, B, n):
    Δṗ = ṗ(*A[:3]) - ṗ(*B[:3])
    return skalar(Δṗ, n)


def richtung(ν, α, β):
    ν = ν / np.linalg.norm(ν, axis=-1, keepdims=True)
    σ = np.where(skalar(ν, np.asarray(α) - β) < 0, -1, 1)
    return σ[..., None] * ν


def edge_edge_normal(α, β, a, b):
    return richtung(np.cross(α, β), a, b)


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
    κ_AB, υ = inverse_effective_mass(A, B, n), normal_velocity(A, B, n)
    frei = κ_AB < ε_nichts
    return np.where(frei, 0.0, -(1 + np.asarray(ε)) * υ / np.where(frei, 1, κ_AB))


def apply_impulse(A, B, J):
    def δ(körper, J):
        v, ω, r, μ, Θ = körper
        return v + np.asarray(μ)[..., None] * J, ω + np.matvec(Θ, np.cross(r, J))

    return δ(A, J) + δ(B, -np.asarray(J))


def collide(A, B, n, ε, η=0.0):
    υ = normal_velocity(A, B, n)
    ι = np.where(υ < -np.asarray(η), impulse_magnitude(A, B, n, ε), 0)
    return apply_impulse(A, B, ι[..., None] * n)


def audit(A, B, danach):
    def Δ(körper, v_nach, ω_nach):
        v, ω, r, μ, Θ = (np.asarray(größe) for größe in körper)
        frei = μ > ε_nichts
        ΔP = np.where(frei, 1 / np.where(frei, μ, 1), 0)[..., None] * (v_nach - v)
        ΔΛ = np.matvec(np.linalg.pinv(Θ), ω_nach - ω)
        return ΔP, ΔΛ + np.cross(ΔP, r), skalar(ΔP, v_nach + v) / 2 + skalar(ΔΛ, ω_nach + ω) / 2

    return tuple(α + β for α, β in zip(Δ(A, *danach[:2]), Δ(B, *danach[2:]), strict=True))
