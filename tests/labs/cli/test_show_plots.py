"""`collisions show`: its plot in the terminal, and in a file."""

from __future__ import annotations

import math
import os
import re
import sys

import pytest
from made_results import seen_of
from program import collisions
from rich.cells import cell_len
from rich.console import Console

from labs.cli import show
from labs.demonstrations.catalogue import find
from reference.report import terminal_plot
from reference.report.terminal_plot import Points

MAGIC = {".svg": b"<?xml", ".png": b"\x89PNG", ".pdf": b"%PDF"}
pytestmark = pytest.mark.usefixtures("screen")


# In the terminal


def lines_of(demonstration: str) -> list:
    return list(seen_of(find(demonstration)).implementations.values())


def test_no_plot_is_drawn_with_the_option_no_plot(without_runs):
    without_runs()
    said = collisions("show", "bounce", "--no-plot")
    assert "time, s" not in said.output
    assert "time of rest" in said.output


def test_without_plotext_the_rest_is_shown_with_how_to_install_it(without_runs, monkeypatch):
    without_runs()
    monkeypatch.setitem(sys.modules, "plotext", None)
    said = collisions("show", "bounce")
    assert said.code == 0
    assert 'pip install -e ".[show]"' in said.output
    assert "time, s" not in said.output
    assert "time of rest" in said.output


def test_a_wider_and_higher_terminal_is_used(without_runs, screen):
    pytest.importorskip("plotext")
    without_runs()
    sizes = {}
    for width, height in ((80, 24), (120, 24), (120, 45), (400, 45)):
        screen(width, height)
        said = collisions("show", "roll")
        (axis,) = [number for number, line in enumerate(said.lines) if "└" in line]
        sizes[width, height] = cell_len(said.lines[axis]), axis
    widths = [size[0] for size in sizes.values()]
    assert widths == [80, 120, 120, show.MOST_WIDTH]
    assert sizes[120, 45][1] > sizes[120, 24][1] + 10


def test_a_plot_has_its_size_its_labels_and_round_numbers():
    pytest.importorskip("plotext")
    xs = [place / 100 for place in range(498)]
    lines = terminal_plot.plot([Points(None, xs, [0.73 * x for x in xs])], "time, s", "way, m", 80, 14).plain.split(
        "\n"
    )
    assert len(lines) == 14
    assert max(map(cell_len, lines)) == 80
    assert lines[0] == "way, m"
    assert lines[-1].split() == ["0", "1", "2", "3", "4", "time,", "s"]
    assert [number for line in lines[1:-2] for number in re.findall(r"^ *([−\d.]+)┤", line)] == ["3", "2", "1", "0"]


def test_coinciding_curves_all_show_their_marks():
    pytest.importorskip("plotext")
    xs = [place / 100 for place in range(500)]
    curves = [Points(line, xs, [math.sin(x) for x in xs]) for line in lines_of("bounce")]
    plain = terminal_plot.plot(curves, "time, s", "", 80, 14).plain
    for curve in curves:
        assert plain.count(terminal_plot.marked(curve.line).plain) >= 2


@pytest.mark.parametrize(("xs", "ys"), [([], []), ([1.0], [2.0]), ([0.0, 1.0], [3.0, 3.0]), ([0, 1e-9], [-1e9, 1e9])])
def test_empty_and_degenerate_curves_can_be_plotted(xs, ys):
    pytest.importorskip("plotext")
    for joined in (True, False):
        text = terminal_plot.plot([Points(lines_of("bounce")[0], xs, ys, joined)], "time, s", "way, m", 80, 11)
        assert len(text.plain.split("\n")) == 11


def test_a_plot_reads_the_same_with_and_without_colour(without_runs, monkeypatch):
    pytest.importorskip("plotext")
    without_runs()
    plain = collisions("show", "bounce").output
    monkeypatch.setattr(
        show, "output", Console(width=80, height=24, force_terminal=True, color_system="256", no_color=False)
    )
    coloured = collisions("show", "bounce").output
    assert "\x1b[38;5;33m■" in coloured
    assert "\x1b[" not in plain
    stripped = re.sub(r"\x1b\[[\d;]*m", "", coloured)
    assert [line.rstrip() for line in stripped.splitlines()] == [line.rstrip() for line in plain.splitlines()]


# In a file


@pytest.mark.parametrize(
    ("name", "suffix"),
    [
        *(("bounce", ".svg"), ("bounce", ".PNG"), ("tunnelling", ".svg"), ("tunnelling", ".pdf")),
        *(
            pytest.param(name, suffix, marks=pytest.mark.slow)
            for name, suffix in (("bounce", ".png"), ("bounce", ".pdf"), ("tunnelling", ".png"), ("tunnelling", ".PNG"))
        ),
    ],
)
def test_the_plot_is_written_to_one_file(name, suffix, tmp_path, without_runs):
    without_runs()
    file = tmp_path / f"plot{suffix}"
    said = collisions("show", name, "--no-plot", "--plot", file)
    assert said.code == 0, said.errors
    content = file.read_bytes()
    assert content.startswith(MAGIC[suffix.lower()])
    assert list(tmp_path.iterdir()) == [file]
    assert str(file) in said.output.replace("\n", "")
    if suffix == ".svg":
        text = content.decode()
        wanted = {"bounce": ("time, s", "gap below the ball, m", "PyBullet, stock"), "tunnelling": ("timestep, ms",)}
        assert all(words in text for words in wanted[name])


def test_the_same_numbers_make_the_same_bytes(tmp_path, without_runs):
    without_runs()
    for name in ("one.svg", "two.svg"):
        collisions("show", "roll", "--no-plot", "--plot", tmp_path / name)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()


@pytest.mark.parametrize(
    ("file", "said"),
    [
        ("plot.gif", "plot.gif' is no picture that can be drawn; it ends in .svg, .png, .pdf"),
        ("plot", "plot' is no picture that can be drawn"),
        ("nowhere/plot.png", "No such file or directory; choose another --plot"),
        ("folder.png", "Is a directory; choose another --plot"),
    ],
)
def test_an_impossible_file_is_refused_before_any_run(file, said, tmp_path, without_runs):
    calls = without_runs()
    (tmp_path / "folder.png").mkdir()
    ended = collisions("show", "bounce", "--plot", tmp_path / file)
    assert (ended.code, calls) == (2, [])
    assert said in ended.error
    assert [path.name for path in tmp_path.iterdir()] == ["folder.png"]


def test_a_full_disk_leaves_the_old_file_and_no_half_of_a_new_one(tmp_path, without_runs, monkeypatch):
    without_runs()
    file = tmp_path / "plot.svg"
    file.write_text("old", encoding="utf-8")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    said = collisions("show", "bounce", "--plot", file)
    assert said.code == 3
    assert "No space left on device" in said.error
    assert (file.read_text(encoding="utf-8"), list(tmp_path.iterdir())) == ("old", [file])
