"""Packages that tests compare our results with, each tried in a process of its own before a test uses it.

A binary wheel may contain instructions that this machine's processor lacks. The process that reaches one is killed, and
under pytest-xdist every test that was still to run in it is lost. So the calls that tests make are made once elsewhere
first, and a package that does not survive them is a reason to skip.
"""

from __future__ import annotations

import functools
import importlib.metadata
import importlib.util
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from types import ModuleType

import pytest

LIMIT = 120.0  # s; the slowest trial takes a second on an idle machine
_FINE = (0, 1)  # 1: it raised an exception, which the test will show if it meets the same one
_FOLDER = "COLLISIONS_ORACLES"

TRIALS = {
    "igl": "igl.winding_number(numpy.eye(3), numpy.array([[0, 1, 2]]), numpy.ones((1, 3)))",
    # The wheels of 1.6.1 for Python 3.12 and 3.13 need AVX-512, and only within these two calls.
    "ipctk": """
features, ccd = numpy.random.default_rng(0).normal(size=(8, 3)), ipctk.TightInclusionCCD()
ccd.point_triangle_ccd(*features)
ccd.edge_edge_ccd(*features)
""",
    "mujoco": """
model = mujoco.MjModel.from_xml_string("<mujoco><worldbody><geom size='1'/></worldbody></mujoco>")
mujoco.mj_step(model, mujoco.MjData(model))
""",
    "navground": """
from navground import core
behavior = core.behaviors.ORCABehavior(core.kinematics.OmnidirectionalKinematics(1.0, 1.0), 0.1)
behavior.target = core.Target.Direction((1.0, 0.0))
behavior.environment_state.neighbors = [core.Neighbor((1.0, 0.0), 0.1, (0.0, 0.0), 1)]
behavior.compute_cmd(0.1)
""",
    "pymunk": """
space, body = pymunk.Space(), pymunk.Body(1, 1)
space.add(body, pymunk.Circle(body, 1), pymunk.Poly.create_box(space.static_body))
space.step(0.1)
""",
    "rtree": "list(rtree.index.Index([(0, (0, 0, 1, 1), None)]).intersection((0, 0, 1, 1)))",
    "scipy": """
from scipy import integrate, interpolate, linalg, optimize, sparse, spatial, special
from scipy.sparse.linalg import spsolve
integrate.solve_ivp(lambda t, y: -y, (0, 1), [1.0], method="DOP853")
linalg.expm(numpy.eye(3))
optimize.linprog([1.0])
optimize.nnls(numpy.eye(3), numpy.ones(3))
spatial.cKDTree(numpy.eye(3)).query_pairs(1.0)
spatial.transform.Rotation.from_quat([0, 0, 0, 1]).as_matrix()
spsolve(sparse.eye(3, format="csc"), numpy.ones(3))
""",
    "shapely": "shapely.contains_xy(shapely.Polygon([(0, 0), (1, 0), (0, 1)]), numpy.ones(3), numpy.ones(3))",
}
"""For each package with compiled code of its own, calls of the kind that tests make."""


def pytest_configure(config: pytest.Config) -> None:
    """Make a folder of results. The workers of the run inherit it, so that no package is tried in each of them."""
    if _FOLDER not in os.environ:
        folder = os.environ[_FOLDER] = tempfile.mkdtemp(prefix="oracles-")
        config.add_cleanup(lambda: os.environ.pop(_FOLDER, None))
        config.add_cleanup(lambda: shutil.rmtree(folder, ignore_errors=True))


def oracle(name: str) -> ModuleType:
    """Import a module to compare with. Where it is missing or crashes, the test is skipped and says so."""
    __tracebackhide__ = True  # a skip is reported at the line of the test
    package = name.partition(".")[0]
    if package in TRIALS and importlib.util.find_spec(package) and (reason := reason_to_skip(package)):
        pytest.skip(reason)
    module: ModuleType = pytest.importorskip(name)
    return module


@functools.cache
def reason_to_skip(package: str) -> str:
    """Why an installed package cannot be used here; empty if it can."""
    result = Path(os.environ[_FOLDER], package)
    if not result.exists():  # two workers may both try it at once: they find the same
        partial = result.with_name(f"{package}-{os.getpid()}")
        partial.write_text(_tried(package), encoding="utf-8")
        partial.replace(result)
    return result.read_text(encoding="utf-8")


def _tried(package: str) -> str:
    try:
        code = exit_code_of_trial(package)
    except subprocess.TimeoutExpired:
        end = f"had not ended after {LIMIT:g} s"
    else:
        if code in _FINE:
            return ""
        end = f"was ended by {signal.Signals(-code).name}" if code < 0 else f"ended with exit code {code:#x}"
    distributions = importlib.metadata.packages_distributions().get(package, [package])
    version = importlib.metadata.version(distributions[0])
    return f"{package} {version} does not run on this machine: a process that tried it {end}"


def exit_code_of_trial(package: str) -> int:
    """Try a package, and return how that process ended: the exit code, or minus the number of a signal."""
    command = [sys.executable, "-c", f"import numpy, {package}\n{TRIALS[package]}"]
    silent = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return subprocess.run(command, timeout=LIMIT, check=False, **silent).returncode
