"""Published cases of motion under forces: free flight, dry friction, viscosity, drag beyond Stokes."""

from __future__ import annotations

from reference.published.case import Published

_FASTEST = (-0.93240737, -0.86473146)
"""Velocity of the body in the middle of P39; the two others have half of it, in the opposite direction."""
_HALF_BACK = (0.93240737 / 2, 0.86473146 / 2)
_EIGHT = (0.97000436, -0.24308753, -0.97000436, 0.24308753, 0.0, 0.0)
"""Places of the three bodies of P39, x and y of one after another."""

CASES = (
    Published(
        number=14,
        title="Free flight, position error of a first-order step",
        statement=30,
        kind="verification",
        source="Gazebo physics benchmark, boxes: a free box under gravity",
        setup={
            "velocity": (-2.0, 2.0, 8.0),
            "gravity": (0.0, 0.0, -9.8),
            "duration": 10.0,
            "timestep": 1e-3,
        },
        expected={"position_error": 0.049},
        tolerance={"position_error": 1e-9},
        reason="g·dt·T/2 exactly; ten thousand roundings of positions up to 400 m",
        note="The benchmark's box turns with ω = (.1, 5, .1); free of torque, its centre flies like a point.",
        units={"position_error": "m"},
    ),
    Published(
        number=16,
        title="Oscillator with dry friction",
        statement=23,
        kind="verification",
        source="Siconos, example FrictionOscillator",
        setup={"mass": 1.0, "stiffness": 1.0, "friction": 1.0, "displacement": 12.0, "velocity": 6.0},
        expected={"turning_point": 13.3178, "fall": 2.0, "sticks_at": 0.68218},
        tolerance={"turning_point": 5e-5, "fall": 1e-12, "sticks_at": 5e-6},
        reason="half of the last digit printed; the fall 2 μN/k of the turning points is exact",
        units={"turning_point": "m", "fall": "m", "sticks_at": "m"},
    ),
    Published(
        number=20,
        title="Viscosity of glycerol from a falling sphere",
        statement=26,
        kind="verification",
        source="Worked problem: a sphere of 205 mg and radius 1.85 mm sinks through glycerol at 39 mm/s",
        setup={
            "mass": 205e-6,
            "radius": 1.85e-3,
            "fluid_density": 1260.0,
            "speed": 0.039,
            "gravity": 9.80665,
        },
        expected={"viscosity": 1.237246, "viscosity_without_buoyancy": 1.4782},
        tolerance={"viscosity": 5e-7, "viscosity_without_buoyancy": 5e-5},
        reason="half of the last digit printed",
        note="Without buoyancy, as on slide 26, the result is 19 % too large. Its Reynolds number is 0.147: with "
        "2.5 % more drag than Stokes' the last five of the seven digits mean nothing.",
        units={"viscosity": "Pa s", "viscosity_without_buoyancy": "Pa s"},
    ),
    Published(
        number=25,
        title="Terminal speed of a sand grain in water",
        statement=26,
        kind="cross-engine",
        source="Documentation of the package fluids, v_terminal",
        setup={
            "radius": 35e-6,
            "density": 2600.0,
            "fluid_density": 1000.0,
            "viscosity": 1e-3,
            "gravity": 9.80665,
        },
        expected={"speed": 0.0041425, "speed_by_stokes": 0.0042713},
        tolerance={"speed": 6e-5, "speed_by_stokes": 5e-8},
        reason="Stokes: half of the last digit printed. With a drag correlation: at Re = 0.29 that of Barati (the "
        "package's choice) has 3.1 % more drag than Stokes and that of Clift, Grace and Weber 4.6 %: 1.4 % apart.",
        note="Theory, 1 + 3/16 Re + 9/160 Re² ln(Re/2), has 4.4 % more, so that Clift, Grace and Weber are nearer.",
        units={"speed": "m/s", "speed_by_stokes": "m/s"},
    ),
    Published(
        number=39,
        title="Three bodies chase each other round a figure of eight",
        statement=25,
        kind="verification",
        source="A. Chenciner, R. Montgomery, A remarkable periodic solution of the three-body problem in the case of "
        "equal masses, Annals of Mathematics 152 (2000) 881-901, initial conditions and period by C. Simó",
        setup={"places": _EIGHT, "velocities": (*_HALF_BACK, *_HALF_BACK, *_FASTEST), "period": 6.32591398},
        expected={"after_a_third": (0.0, 0.0, *_EIGHT[:4]), "after_a_period": _EIGHT},
        tolerance={"after_a_third": 5e-7, "after_a_period": 5e-7},
        reason="the source prints places, velocities and the period to eight decimals, which is 5e-9; in a period in"
        " which the bodies pass each other this error grows up to a hundredfold",
        note="Equal masses with G m = 1, in units of the source. All three are on the same curve: after a third of the "
        "period each is where another was.",
        units={"after_a_third": "m", "after_a_period": "m"},
        labels=dict.fromkeys(
            ("after_a_third", "after_a_period"), tuple(f"body {body}, {axis}" for body in (1, 2, 3) for axis in "xy")
        ),
    ),
    Published(
        number=40,
        title="A block on a spring swings",
        statement=27,
        kind="verification",
        source="OpenStax University Physics, volume 1, section 15.1, example 15.2",
        setup={"mass": 2.0, "stiffness": 32.0, "displacement": 0.02},
        expected={"angular_frequency": 4.0, "period": 1.57, "fastest": 0.08, "acceleration": 0.32},
        tolerance={"angular_frequency": 5e-3, "period": 5e-3, "fastest": 5e-4, "acceleration": 5e-3},
        reason="half of the last digit printed; the largest speed, printed as 0.08, is 0.02 m times 4.00/s",
        units={"angular_frequency": "rad/s", "period": "s", "fastest": "m/s", "acceleration": "m/s²"},
    ),
)
