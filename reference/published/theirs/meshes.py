"""Published cases of meshes of springs: a hanging cable, and frames of bars that are shaky."""

from __future__ import annotations

from reference.published.case import Published

CASES = (
    Published(
        number=35,
        title="What a hanging elastic cable pulls at its two ends",
        statement=28,
        kind="cross-engine",
        source="MoorPy (NREL/MoorPy), tests/test_catenary.py, indata[4]: its closed form of an elastic catenary",
        setup={"along": 89.9, "up": 59.2, "length": 130.0, "axial_stiffness": 751e6, "weight": 881.05},
        expected={
            "horizontal": 31373.229006023103,
            "at_lower_end": 26650.341270116318,
            "at_upper_end": 87886.15872988368,
        },
        tolerance={"horizontal": 0.12, "at_lower_end": 0.064, "at_upper_end": 0.064},
        reason="the test lets its solver stop at Tol = 1e-6, here taken as a share of the two distances between the"
        " ends; the pulls of this cable change by 1073 N for each metre along the ground and by 631 N for each metre"
        " of height, and each of the two by 287 N for a metre in the direction of the other",
        note="The cable is 130 m long before it stretches and weighs 881.05 N/m; its ends are 89.9 m apart along the"
        " ground and 59.2 m in height. It hangs below both ends, and the vertical pulls, both downwards, add up to its"
        " weight. In the source the two forces on the upper end have the opposite sign of ours. Of the seventeen"
        " digits printed, seven are those of an elastic catenary, which gives 31373.2349, 26650.3387 and 87886.1613 N."
        " Where their solver stopped, the ends were still 5 and 2 µm from their places.",
        units={"horizontal": "N", "at_lower_end": "N", "at_upper_end": "N"},
    ),
    Published(
        number=36,
        title="Frames with as many bars as a rigid frame needs, some of which are shaky",
        statement=28,
        kind="verification",
        source="C. R. Calladine, Buckminster Fuller's \"tensegrity\" structures and Clerk Maxwell's rules for the "
        "construction of stiff frames, Int. J. Solids Structures 14 (1978) 161-172: six struts and 24 tendons; "
        "A. G. Tibert, S. Pellegrino, Review of form-finding methods for tensegrity structures, Int. J. Space "
        "Structures 18 (2003) 209-223: the prism is shaky at a twist of π/2 − π/3",
        setup={
            "struts": 6.0,
            "tendons": 24.0,
            "stretched_vertex": (2.0, 1.0, 0.0),
            "prism_height": 1.3,
            "twists": (30.0, 25.0, -60.0),
        },
        expected={"expanded_octahedron": 1.0, "icosahedron": 0.0, "prism": (1.0, 0.0, 0.0)},
        tolerance={"expanded_octahedron": 0.0, "icosahedron": 0.0, "prism": 0.0},
        reason="a count",
        note="The numbers count the independent motions that change no bar's length to first order, besides the six of"
        " a rigid body. A rigid frame of twelve joints needs 3 × 12 − 6 = 30 bars, and one of six joints needs 12;"
        " each of these frames has exactly as many. The vertices of the expanded octahedron are the cyclic"
        " permutations of (±2, ±1, 0). The prism is two triangles of side √3, one above the other and turned, with"
        " three vertical and three slanting bars between them.",
        labels={"prism": ("turned by 30°", "turned by 25°", "turned by −60°, a regular one")},
    ),
)
