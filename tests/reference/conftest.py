"""What the tests of the grid share: a run is made once, whichever test asks for it first."""

from __future__ import annotations

import pytest
from engine_grid import Cell, run

from reference.scene.trajectory import Trajectory


@pytest.fixture
def trajectory(cell: Cell, installed) -> Trajectory:
    installed(cell.engine)
    return run(cell)
