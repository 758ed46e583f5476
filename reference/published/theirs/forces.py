"""Published cases of motion under forces: free flight, dry friction, viscosity, drag beyond Stokes."""

from __future__ import annotations

from reference.published.case import Published

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
)
