"""Which version of a function is in use, where it is written several times."""

from __future__ import annotations

import pytest
from cells import said

from labs.desk.versions import earlier_versions

FIRST = 'def side_of_plane(separation, tolerance=0.0):\n    """First version: no tolerance."""\n    return 1'
STUB = (
    'def side_of_plane(separation, tolerance=0.0):\n    """The side."""\n'
    '    raise NotImplementedError("detection, step 2: side_of_plane is yours to write again")'
)
LAST = STUB.rpartition("\n")[0] + "\n    return 2"
DISTANCE = "def signed_distance(point, normal, offset):\n    return (point * normal).sum(axis=-1) + offset"
BARE = "def side_of_plane(separation, tolerance=0.0):\n    return 2"
NOT_YET = "side_of_plane: the version in cell [{}] is in use, because the last one is not written yet."


@pytest.mark.parametrize(
    ("cells", "line"),
    [
        ((FIRST, STUB), NOT_YET.format(1)),
        ((FIRST, STUB, "%timeit 1", FIRST), NOT_YET.format(4)),
        ((FIRST, STUB, LAST, FIRST), "side_of_plane: the earlier version in cell [4] is in use, because"),
        ((FIRST, STUB, LAST), ""),
        ((FIRST, STUB, BARE), ""),
        ((FIRST, "def side_of_plane(:", STUB, BARE), ""),
        ((FIRST,), ""),
        ((STUB,), ""),
    ],
)
def test_an_earlier_version_in_use_is_named_with_its_cell(cells, line):
    told = earlier_versions(cells).get("side_of_plane", "")
    assert told.startswith(line)
    assert bool(told) == bool(line)


def test_a_run_says_that_it_takes_an_earlier_version(lab, cells, capsys, one_worker):
    cells += [FIRST.replace("return 1", "return -1.0 * (separation < 0)"), STUB, DISTANCE]
    lab.run("dropped-ball/e=0.5", engines=(), profile="step", timestep=0.01)
    assert NOT_YET.format(1) in capsys.readouterr().out
    assert NOT_YET.format(1) in said(capsys, lab.check, "side_of_plane")
