"""Forces side by side: drag and terminal speeds, springs in a row, an orbit."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from labs.benching.timing import Bench
from solutions import forces

GRAVITY = np.array([0.0, 0.0, -9.80665])
SPRINGS, STEPS = 1000, 200


def correction() -> Callable[[], object]:
    """A hundred thousand Reynolds numbers."""
    reynolds = np.geomspace(0.02, 3e5, 100_000)
    return lambda: forces.drag_correction(reynolds)


def correction_fluids() -> Callable[[], object]:
    """The package's vectorised function, the same fit."""
    from fluids import vectorized  # noqa: PLC0415

    reynolds = np.geomspace(0.02, 3e5, 100_000)
    return lambda: vectorized.Clift(reynolds) * reynolds / 24


def grains() -> Callable[[], object]:
    """Terminal velocities of a thousand grains of sand in water."""
    radius = np.geomspace(1e-6, 1e-3, 1000)
    return lambda: forces.terminal_velocity_corrected(radius, 2600.0, 1000.0, 1e-3, GRAVITY)


def grains_fluids() -> Callable[[], object]:
    """The same, one after another: the package has no other way."""
    from fluids import v_terminal  # noqa: PLC0415

    diameters = (2 * np.geomspace(1e-6, 1e-3, 1000)).tolist()
    return lambda: [v_terminal(D=d, rhop=2600.0, rho=1000.0, mu=1e-3, Method="Clift") for d in diameters]


def springs() -> Callable[[], object]:
    """A thousand masses on damped springs, two hundred steps of semi-implicit Euler."""
    start = np.tile([1.3, 0.0, 0.0], (SPRINGS, 1))

    def run() -> object:
        p, v, anchor = start, np.zeros((SPRINGS, 3)), np.zeros(3)
        for _ in range(STEPS):
            a = forces.spring_damper_force(p, anchor, v, anchor, 8.0, 1.0, 0.5) / 2.0
            p, v = forces.semi_implicit_euler(p, v, a, 1e-3)
        return p

    return run


def springs_mujoco() -> Callable[[], object]:
    """The same as slide joints, with the engine's Euler."""
    import mujoco

    joint = '<joint type="slide" axis="1 0 0" stiffness="8" damping=".5" springref="1"/>'
    one = f'<body>{joint}<geom size=".1" mass="2"/></body>'
    option = '<option gravity="0 0 0" timestep=".001"><flag contact="disable"/></option>'
    model = mujoco.MjModel.from_xml_string(f"<mujoco>{option}<worldbody>{one * SPRINGS}</worldbody></mujoco>")

    def run() -> object:
        state = mujoco.MjData(model)
        state.qpos[:] = 1.3
        mujoco.mj_step(model, state, STEPS)
        return state.qpos

    return run


def orbit() -> Callable[[], object]:
    """One turn of an ellipse by a thousand Runge–Kutta steps."""
    mass = 1 / forces.GRAVITATIONAL_CONSTANT

    def pull(p: np.ndarray, v: np.ndarray) -> np.ndarray:
        return forces.universal_gravity(1.0, mass, p, np.zeros(3))

    def run() -> object:
        p, v = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.2, 0.0])
        for _ in range(1000):
            p, v = forces.runge_kutta_4(p, v, pull, 0.0150)
        return p

    return run


def orbit_scipy() -> Callable[[], object]:
    """The same by DOP853 to 1e-9, which chooses its own steps, with the same function for the pull."""
    from scipy.integrate import solve_ivp  # noqa: PLC0415

    mass, start = 1 / forces.GRAVITATIONAL_CONSTANT, [1.0, 0.0, 0.0, 0.0, 1.2, 0.0]

    def rate(_: float, state: np.ndarray) -> np.ndarray:
        return np.concatenate([state[3:], forces.universal_gravity(1.0, mass, state[:3], np.zeros(3))])

    return lambda: solve_ivp(rate, (0, 15.0), start, method="DOP853", rtol=1e-9, atol=1e-9)


BENCHES = (
    Bench("drag-correction", "drag of 100 000 spheres over Stokes'", correction, {"fluids": correction_fluids}),
    Bench("terminal-velocity", "1000 grains of sand that sink in water", grains, {"fluids": grains_fluids}),
    Bench("damped-springs", f"{SPRINGS} masses on springs, {STEPS} steps", springs, {"MuJoCo": springs_mujoco}),
    Bench("orbit", "one turn around the sun, to 2e-8", orbit, {"scipy DOP853": orbit_scipy}),
)
