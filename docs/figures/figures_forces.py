"""Figures of the forces: statements 23, 25, 26, 27, 29 and 30."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from solutions import as_printed, forces

STILL = np.zeros(3)
WIDTH = 1.6


def turning_points(figure: Figure) -> None:
    """Two oscillators, one with dry friction and one with a damper.

    Dry friction takes the same 2 μN/k from every swing, and the mass sticks aside of its rest. A damper takes the same
    share, and the swings never end.
    """
    axes = figure.add_subplot()
    t = np.linspace(0, 26, 1500)
    rubbed, _ = forces.friction_oscillator(12.0, 6.0, 1.0, 1.0, 1.0, t)
    damped, _ = forces.damped_oscillator(12.0, 6.0, 1.0, 0.15, 1.0, t)
    axes.plot(t, damped, "--", lw=1.2, color="#0072b2", label="damper")
    axes.plot(t, rubbed, lw=WIDTH, color="#1b1b1b", label="dry friction, μN/k = 1 m")
    first = np.arctan2(6, 13)
    axes.plot(first + np.array([0, 22]), 13.3178 - 2 / np.pi * np.array([0, 22]), ":", color="#d55e00")
    axes.annotate("falls by 2 m\na half swing", (14, 5.4), color="#d55e00", fontsize=9)
    axes.annotate("sticks at 0.68 m", (24, 0.68), (18.5, -7), arrowprops={"arrowstyle": "-", "lw": 0.8}, fontsize=9)
    axes.axhline(0, lw=0.5, color="grey")
    axes.set(xlabel="time, s", ylabel="place, m", title="Friction and damping are different forces", ylim=(-16, 19))
    axes.legend(loc="upper right", ncols=2)


def fall_of_the_earth(figure: Figure) -> None:
    """The pull of the Earth, with Newton's law and as a uniform one.

    On the scale of a ball game nothing can be seen of the difference. The slide's 32 ft/s² is what Newton's law gives
    22 km above the ground.
    """
    axes = figure.add_subplot()
    height = np.linspace(0, 2000, 400)
    law = forces.surface_gravity(5.9722e24, 6.371e6 + 1e3 * height)
    axes.plot(height, law, lw=WIDTH, label="G M/r²")
    axes.axhline(law[0], ls="--", color="#0072b2", label=f"uniform, {law[0]:.3f} m/s²")
    box = axes.inset_axes((0.58, 0.38, 0.4, 0.38))
    box.plot(height, law, lw=WIDTH)
    box.axhline(law[0], ls="--", color="#0072b2")
    box.axhline(forces.STANDARD_GRAVITY, ls="-.", color="#009e73")
    box.axhline(as_printed.gravity_in_feet(), ls=":", lw=2, color="#d55e00")
    box.text(29.5, 9.805, "g₀ = 9.80665", fontsize=8, color="#009e73", va="top", ha="right")
    box.text(1, 9.7555, "32 ft/s² = 9.7536", fontsize=8, color="#d55e00", va="bottom")
    box.set(xlim=(0, 30), ylim=(9.74, 9.83))
    box.tick_params(labelsize=8)
    axes.set(xlabel="height above the ground, km", ylabel="acceleration of fall, m/s²", ylim=(5, 11.2))
    axes.set_title("Newton's pull, the uniform one, and 32 ft/s²")
    axes.legend(loc="upper right", ncols=2)


def orbits(figure: Figure) -> None:
    """One turn around the sun in 60 steps by four methods.

    Explicit Euler spirals outwards. Semi-implicit Euler closes a slightly wrong ellipse at the same cost; Verlet nearly
    covers the true one, and Runge–Kutta's four forces a step do.
    """
    axes = figure.add_subplot()
    mass = 1 / forces.GRAVITATIONAL_CONSTANT
    period = 2 * np.pi * (2 - 1.1**2) ** -1.5
    styles = {"explicit_euler": ("--", "#d55e00"), "semi_implicit_euler": ("-.", "#0072b2")}
    styles |= {"velocity_verlet": (":", "#009e73"), "runge_kutta_4": ("-", "#1b1b1b")}
    for name, (line, colour) in styles.items():
        path = [(np.array([1.0, 0, 0]), np.array([0, 1.1, 0]))]
        for _ in range(60):
            step = getattr(forces, name)
            path.append(step(*path[-1], lambda p, v: forces.universal_gravity(1.0, mass, p, STILL), period / 60))
        place = np.array([p for p, _ in path])
        axes.plot(place[:, 0], place[:, 1], line, color=colour, lw=WIDTH, label=name.replace("_", " "))
    axes.plot(0, 0, "o", ms=9, color="#cc79a7")
    axes.set(xlabel="x", ylabel="y", title="An orbit in sixty steps")
    axes.set_aspect("equal")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))


def bubble(figure: Figure) -> None:
    """Terminal velocity of a sphere of 10 µm in water over its density.

    The slide forgets the buoyancy, so that its bubble sinks. With it the velocity goes through zero at the density of
    the water, and light spheres rise.
    """
    axes = figure.add_subplot()
    density = np.linspace(0, 3000, 301)
    right = -1e6 * forces.terminal_velocity(1e-5, density, 1000.0, 1e-3, (0, 0, -9.81))[:, 2]
    printed = 1e6 * as_printed.terminal_speed(density * 4 / 3 * np.pi * 1e-15, 9.81, 1e-5, 1e-3)
    axes.plot(density, printed, "--", color="#d55e00", lw=WIDTH, label="slide: m g = 6πr η v")
    axes.plot(density, right, lw=WIDTH, label="with buoyancy: 2(ρ − ρ_f) g r²/(9η)")
    axes.axhline(0, lw=0.5, color="grey")
    for name, at in (("air", 1.2), ("water", 1000.0), ("sand", 2600.0)):
        axes.plot([at] * 2, [np.interp(at, density, right), np.interp(at, density, printed)], ":", color="grey", lw=1)
        axes.annotate(name, (at, np.interp(at, density, right)), (6, -13), textcoords="offset points", fontsize=9)
    axes.set(
        xlabel="density of the sphere, kg/m³", ylabel="sinks with, µm/s", ylim=(-300, 720), title="A bubble must rise"
    )
    axes.legend(loc="upper left")


def shape(figure: Figure) -> None:
    """Drag of a spheroid of given volume along and across its axis, exactly, and what MuJoCo's two fluid models take.

    A rod lengthwise has far less drag than broadside, a disc the reverse. Both models of MuJoCo know no direction. The
    box model takes the box with the same inertia, 22.5 % too little for a sphere; the ellipsoid model the mean axis.
    """
    axes = figure.add_subplot()
    ratio = np.geomspace(0.05, 20, 300)
    across = ratio ** (-1 / 3)
    along = ratio * across
    exact = forces.spheroid_shape_factors(along, across) / (6 * np.pi)
    box = (2 * np.sqrt(0.6) * across + np.sqrt(0.6) * along) / 3  # half sides √(3/5) of the semi-axes
    axes.semilogx(ratio, exact[:, 0], lw=WIDTH, label="exact, along the axis")
    axes.semilogx(ratio, exact[:, 1], "--", lw=WIDTH, label="exact, across it")
    axes.semilogx(ratio, (2 * across + along) / 3, "-.", lw=1.2, color="#d55e00", label="MuJoCo's ellipsoid model")
    axes.semilogx(ratio, box, ":", lw=1.8, color="#009e73", label="MuJoCo's box model")
    axes.plot(1, 1, "o", ms=5, color="#1b1b1b")
    axes.annotate("sphere", (1, 1), (0, -15), textcoords="offset points", ha="center", fontsize=9)
    axes.set_xticks([0.1, 1, 10], ["0.1\ndisc", "1", "10\nrod"])
    axes.set(xlabel="length over width", ylabel="K over that of the sphere", ylim=(0.6, 2.7))
    axes.set_title("What the slide calls shape")
    axes.legend(loc="upper center")


def spring_sign(figure: Figure) -> None:
    """A mass let go 1 cm from rest, with the slide's force and with the right one.

    k (x − x_rest) pushes the mass away from its rest: one second later it is gone. With the minus sign it swings.
    """
    axes = figure.add_subplot()
    dt, count = 2e-3, 1000
    t = dt * np.arange(count + 1)
    paths: dict[str, list[float]] = {"printed": [1.01], "right": [1.01]}
    for name, path in paths.items():
        x, v = np.array([1.01, 0, 0]), STILL
        for _ in range(count):
            wrong = as_printed.spring_force(x, (1.0, 0, 0), 10.0)
            right = forces.spring_force(x, STILL, 10.0, 1.0)
            x, v = forces.semi_implicit_euler(x, v, wrong if name == "printed" else right, dt)
            path.append(float(x[0]))
    axes.plot(t, 100 * (np.array(paths["printed"]) - 1), "--", color="#d55e00", lw=WIDTH, label="slide: k (x − x_rest)")
    axes.plot(t, 100 * (np.array(paths["right"]) - 1), lw=WIDTH, label="right: −k (x − x_rest)")
    axes.set(xlabel="time, s", ylabel="distance from rest, cm", ylim=(-2, 12), title="The sign of a spring")
    axes.annotate("runs away as cosh ωt", (1.0, 11.0), (1.05, 10.5), fontsize=9, color="#d55e00")
    axes.legend(loc="upper left")


def damped_as_printed(figure: Figure) -> None:
    """The slide's spring with a damper, at three strengths of the damper, and the right one.

    As printed the motion diverges whatever the damping, which only delays it. With the right sign it comes to rest.
    """
    left, right = figure.subplots(1, 2)
    for damping, line in ((0.5, "-"), (2.0, "--"), (8.0, ":")):
        dt, count = 2e-3, 1500
        x, v, path = np.array([1.0, 0, 0]), STILL, [1.0]
        for _ in range(count):
            force = as_printed.spring_damper_force(x, STILL, 4.0, v, damping)
            x, v = forces.semi_implicit_euler(x, v, force, dt)
            path.append(float(x[0]))
        t = dt * np.arange(count + 1)
        left.plot(t, path, line, color="#d55e00", lw=WIDTH)
        swing, _ = forces.damped_oscillator(1.0, 0.0, 4.0, damping, 1.0, 2 * t)
        right.plot(2 * t, swing, line, color="#1b1b1b", lw=WIDTH, label=f"k_d = {damping:g} N s/m")
    left.set(xlabel="time, s", ylabel="stretch, cm", ylim=(0, 20), title="(x' − x_rest) k − v k_d")
    right.set(xlabel="time, s", title="−k (L − L0) u − k_d (v·u) u", ylim=(-1.1, 1.6))
    right.axhline(0, lw=0.5, color="grey")
    right.legend(loc="upper right")


def stable_steps(figure: Figure) -> None:
    """Largest stable steps of both Eulers for a spring with a damper.

    Without a damper explicit Euler has none, and semi-implicit Euler has 2/ω. Strong damping shortens both steps.
    """
    axes = figure.add_subplot()
    ratio = np.linspace(0, 2.5, 501)
    limits = forces.spring_step_limit(1.0, 1.0, 2 * ratio)
    for name, line, limit in zip(("explicit Euler", "semi-implicit Euler"), (":", "--"), limits, strict=True):
        axes.plot(ratio, limit, line, lw=WIDTH, label=name)
    axes.axvline(1, lw=0.5, color="grey")
    axes.annotate("critical", (1, 0.06), (1.03, 0.06), fontsize=9, color="#555555")
    axes.set(xlabel="damping ratio ζ", ylabel="largest stable ω dt", ylim=(0, 2.3), xlim=(0, 2.5))
    axes.set_title("How long a step may be")
    axes.legend(loc="upper right")


def energy_of_integrators(figure: Figure) -> None:
    """Energy of an undamped spring over a hundred swings, at ω dt = 0.2.

    Explicit Euler gains energy in every step and implicit Euler loses it. Semi-implicit Euler's swings about a constant
    and does not drift; Right, on another scale: Verlet's stays within 1 %, and Runge–Kutta loses a little steadily.
    """
    left, right = figure.subplots(1, 2, width_ratios=(2, 1))
    turns, dt = 100, 0.2
    count = round(turns * 2 * np.pi / dt)
    styles = {"explicit_euler": ":", "implicit_euler": "-.", "semi_implicit_euler": "-"}
    colours = {"explicit_euler": "#d55e00", "implicit_euler": "#009e73", "semi_implicit_euler": "#0072b2"}
    energies = {name: _energies(name, dt, count) for name in (*styles, "velocity_verlet", "runge_kutta_4")}
    swings = dt * np.arange(count + 1) / (2 * np.pi)
    for name, line in styles.items():
        left.semilogy(swings, energies[name], line, color=colours[name], label=name.replace("_", " "))
    left.set(xlabel="swings", ylabel="energy over the first", ylim=(1e-3, 1e5), title="Who keeps the energy")
    left.legend(loc="upper right")
    right.plot(swings, energies["velocity_verlet"], color="#cc79a7", lw=0.8, label="velocity verlet")
    right.plot(swings, energies["runge_kutta_4"], "--", color="#1b1b1b", lw=WIDTH, label="runge kutta 4")
    right.set(xlabel="swings", ylim=(0.985, 1.022))
    right.legend(loc="upper right")


def _energies(name: str, dt: float, count: int) -> np.ndarray:
    state, energy = (np.array([1.0]), np.array([0.0])), [1.0]
    for _ in range(count):
        state = getattr(forces, name)(*state, lambda p, v: -p, dt)
        energy.append(float(state[0][0] ** 2 + state[1][0] ** 2))
    return np.array(energy)


def audit(figure: Figure) -> None:
    """Two masses on a spring with a damper fall through a wind; the energy that each force has brought in so far.

    The black line is the kinetic energy gained, by the velocities alone. It is the sum of the four others.
    """
    axes = figure.add_subplot()
    mass, dt, count = np.array([1.0, 2.0]), 2e-3, 500

    def ends(force: np.ndarray) -> np.ndarray:
        return np.stack([force, -force], axis=-2)

    def spring(p: np.ndarray, v: np.ndarray) -> np.ndarray:
        return ends(forces.spring_force(p[..., 0, :], p[..., 1, :], 60.0, 1.0))

    def damper(p: np.ndarray, v: np.ndarray) -> np.ndarray:
        return ends(forces.damper_force(p[..., 0, :], p[..., 1, :], v[..., 0, :], v[..., 1, :], 1.5))

    all_forces = [
        forces.Force("weight", "position", lambda p, v: forces.uniform_gravity(mass, (0, 0, -9.81))),
        forces.Force("spring", "position", spring),
        forces.Force("damper", "velocity", damper),
        forces.Force("wind", "velocity", lambda p, v: forces.wind_force(v, (12.0, 0, 0), 0.1, 0.47, 1.2)),
    ]
    state = (np.array([[0.0, 0, 0], [1.8, 0, 0]]), np.zeros((2, 3)))
    path = [state]
    for _ in range(count):
        path.append(forces.velocity_verlet(*path[-1], forces.acceleration_of(all_forces, mass), dt))
    found = forces.audit_energy(all_forces, mass, np.array([p for p, _ in path]), np.array([v for _, v in path]), dt)
    t = dt * np.arange(count + 1)
    axes.plot(t, found.kinetic, lw=2.2, color="#1b1b1b", label="kinetic energy")
    for (name, work), line in zip(found.work.items(), ("--", "-", ":", "-."), strict=True):
        axes.plot(t, work, line, lw=1.3, label=f"work of {name}")
    worst = np.abs(found.residual()).max()
    axes.set(xlabel="time, s", ylabel="J", xlim=(0, 1.0), ylim=(-30, 190))
    axes.set_title(f"Every joule is accounted for, to {1e3 * worst:.0f} mJ")
    axes.legend(loc="upper left", ncols=2)


def wind(figure: Figure) -> None:
    """Seeds let go in a whirl of air: the field is sampled at their place, and pulls on them through v − w.

    A light seed soon goes along with the wind; a heavy one flies on and is flung out of the whirl.
    """
    axes = figure.add_subplot()
    side = np.linspace(-4, 4, 41)
    x, y = np.meshgrid(side, side, indexing="ij")
    swirl = np.stack([-y, x, np.zeros_like(x)], axis=-1)[:, :, None, :] * 2
    axes.quiver(x[::2, ::2], y[::2, ::2], -y[::2, ::2], x[::2, ::2], color="#aaaaaa", width=0.004, scale=70)
    for mass, line, colour in ((0.01, "-", "#1b1b1b"), (0.1, "--", "#0072b2"), (1.0, ":", "#d55e00")):
        p, v = np.array([1.0, 0, 0]), np.array([0, 2.0, 0])
        path = [p]
        for _ in range(300):

            def acceleration(p: np.ndarray, v: np.ndarray, m: float = mass) -> np.ndarray:
                air = forces.sample_field(p, swirl, (-4.0, -4.0, 0.0), 0.2)
                return forces.stokes_drag(v, air, 0.1, 1.0) / m

            p, v = forces.runge_kutta_4(p, v, acceleration, 0.005)
            path.append(p)
        axes.plot(*np.array(path)[:, :2].T, line, color=colour, lw=2, label=f"τ = {mass / 0.1:g} s")
    axes.plot(1, 0, "o", color="#1b1b1b", ms=5)
    axes.set(xlabel="x, m", ylabel="y, m", title="Wind acts through v − w", xlim=(-2.6, 2.6), ylim=(-1.5, 2.6))
    axes.set_aspect("equal")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), title="relaxation time")


def regimes(figure: Figure) -> None:
    """The damped oscillator in its three regimes, and the closed form beside steps of the forces.

    Critical damping comes to rest soonest; less of it swings, more of it creeps.
    """
    axes = figure.add_subplot()
    t = np.linspace(0, 8, 400)
    for ratio, line, words in ((0.15, "-", "under"), (1.0, "--", "critical"), (4.0, ":", "over")):
        stretch, _ = forces.damped_oscillator(1.0, 0.0, 4.0, 4 * ratio, 1.0, t)
        axes.plot(t, stretch, line, lw=WIDTH, label=f"ζ = {ratio:g}, {words}")
    axes.axhline(0, lw=0.5, color="grey")
    axes.set(xlabel="time, s", ylabel="stretch over the first", title="To calm down spring oscillations")
    axes.legend(loc="upper right")


FIGURES = {
    (23, "friction-oscillator"): turning_points,
    (25, "gravity-and-height"): fall_of_the_earth,
    (25, "orbit-in-sixty-steps"): orbits,
    (26, "a-bubble-must-rise"): bubble,
    (26, "shape"): shape,
    (27, "sign-of-a-spring"): spring_sign,
    (29, "damping-as-printed"): damped_as_printed,
    (29, "three-regimes"): regimes,
    (29, "stable-steps"): stable_steps,
    (30, "energy-of-integrators"): energy_of_integrators,
    (30, "energy-audit"): audit,
    (30, "wind"): wind,
}
