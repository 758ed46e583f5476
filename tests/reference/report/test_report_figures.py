"""The report's figures: the same bytes for the same numbers, ids of their own, and nothing told by colour alone."""

from __future__ import annotations

import functools
import math
import re
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from xml.etree import ElementTree

import pytest

from reference.catalogue.scenarios import catalogue
from reference.comparison.convergence import Errors
from reference.comparison.curves import Series
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.engines import engine_names, load_engine
from reference.report import figures
from reference.report.sections import Section, sections

SVG, XLINK = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}"
STEPS = (4e-3, 2e-3, 1e-3, 5e-4)
both = pytest.mark.parametrize("draw", [figures.trajectories, figures.convergence])
DRAWN = ("ball-to-rest", "off-centre-impact")
"""Every line of `figures` draws these: the first has a unit, four curves that count and an interpolated profile, the
second none, the most profiles, and profiles without dashes of their own. Of the other families only the styles can
differ, and a style is tested without a drawing, which takes half a second."""
both_families = pytest.mark.parametrize("family", DRAWN)


def results(family: str) -> list[JobResult]:
    """What every engine and profile of a family might give: a curve each, and errors of first order."""
    found = []
    for name in engine_names():
        engine = load_engine(name)
        for profile in engine.profiles(catalogue()[family].cases[0].scenarios[0]):
            shift = 0.01 * len(found)
            times = tuple(0.01 * step for step in range(200))
            curve = Series(times, tuple(math.exp(-time) + shift for time in times))
            errors = Errors(STEPS, tuple((1 + shift) * dt for dt in STEPS), 1.0)
            row = Row(family, "all", name, profile, "", "", Verdict.SHOWN)
            job = Job(family, name, profile)
            found.append(JobResult(job, engine.title, "", (row,), series=curve, convergence=errors))
    return found


def section(family: str = "ball-to-rest", change: Callable[[JobResult], JobResult] = lambda it: it) -> Section:
    (found,) = sections([change(result) for result in results(family)])
    return found


@functools.cache
def drawn(family: str, draw: Callable[[Section], str]) -> str:
    return draw(section(family))


def alone(**changes: object) -> Section:
    (found,) = sections([replace(results("ball-to-rest")[0], **changes)])
    return found


@dataclass(frozen=True)
class Entry:
    """One line of a legend, as it is drawn."""

    label: str
    colour: str
    dashes: str
    marker: str
    face: str


def style(element: ElementTree.Element) -> dict[str, str]:
    return dict(re.findall(r"([\w-]+): ([^;]+)", element.get("style", "")))


def markers(axes: ElementTree.Element) -> list[tuple[ElementTree.Element, dict[str, str]]]:
    """The markers of the lines, each with its style or that of its group; ticks have none."""
    found = [(use, style(group) | style(use)) for group in axes.iter(f"{SVG}g") for use in group.findall(f"{SVG}use")]
    return [(use, its) for use, its in found if "fill" in its]


def legend(svg: str) -> list[Entry]:
    """What the legend shows: each handle, a piece of the line with its marker, is followed by its text."""
    root = ElementTree.fromstring(svg)
    marks = {path.get("id"): path.get("d") for path in root.iter(f"{SVG}path") if path.get("id")}
    (box,) = (group for group in root.iter(f"{SVG}g") if group.get("id", "").endswith("-legend_1"))
    handles, entries = [group for group in box if "line2d" in group.get("id", "")], []
    texts = [text.text for text in box.iter(f"{SVG}text")]
    for handle, label in zip(handles, texts, strict=True):
        stroke, mark = style(handle.find(f"{SVG}path")), handle.find(f".//{SVG}use")
        shape = " ".join(marks[mark.get(f"{XLINK}href")[1:]].split())
        dashes = stroke.get("stroke-dasharray", "")
        entries.append(Entry(label, stroke["stroke"], dashes, shape, style(mark)["fill"]))
    return entries


@both
def test_the_same_numbers_give_the_same_bytes(draw):
    assert draw(section()) == drawn("ball-to-rest", draw)


@both
@both_families
def test_a_figure_is_one_self_contained_svg_element(family, draw):
    svg = drawn(family, draw)
    assert ElementTree.fromstring(svg).tag == f"{SVG}svg"
    assert svg.startswith("<svg")
    addresses = re.findall(r"\w+://[^\s\"'<>]*", re.sub(r'xmlns(:\w+)?="[^"]*"', "", svg))
    assert addresses == []
    assert "<image" not in svg
    assert not re.search(r"\b(19|20)\d\d-\d\d-\d\d", svg), "a date would change the bytes from day to day"


@both
@both_families
def test_a_figures_ids_contain_its_name_and_references_have_targets(family, draw):
    svg = drawn(family, draw)
    ids = re.findall(r'\bid="([^"]+)"', svg)
    references = re.findall(r'href="#([^"]+)"|url\(#([^)]+)\)', svg)
    assert max(Counter(ids).values()) == 1
    assert all(name.startswith(f"{family}-{draw.__name__}-") for name in ids)
    assert references
    assert {here or there for here, there in references} <= set(ids)
    assert len(re.findall(r"href=|url\(", svg)) == len(references), "nothing refers to anything outside"


def test_figures_of_two_families_fit_in_one_page_without_sharing_an_id():
    svgs = [drawn(family, draw) for family in DRAWN for draw in (figures.trajectories, figures.convergence)]
    ids = [name for svg in svgs for name in re.findall(r'\bid="([^"]+)"', svg)]
    assert max(Counter(ids).values()) == 1


@both
@both_families
def test_the_legend_names_every_line_in_the_order_of_the_tables(family, draw):
    found = section(family)
    names = [entry.label.partition(": ")[0] for entry in legend(drawn(family, draw))]
    assert names == [line.title for line in found.lines]


@both
@both_families
def test_engines_differ_by_marker_and_profiles_by_dashes(family, draw):
    found = section(family)
    entries = list(zip(found.lines, legend(drawn(family, draw)), strict=True))
    for one, left in entries:
        for other, right in entries:
            same_engine = one.result.job.engine == other.result.job.engine
            assert (left.marker == right.marker) == same_engine, (left.label, right.label)
            assert (left.colour == right.colour) == same_engine, (left.label, right.label)
            if same_engine and one is not other:
                assert left.dashes != right.dashes, (left.label, right.label)
    assert {line.counts for line, entry in entries if not entry.dashes} == {True}
    assert {line.counts for line, entry in entries if entry.face == entry.colour} == {True}


def test_no_two_profiles_of_an_engine_have_the_same_dashes_in_any_family():
    for family in catalogue():
        styles = [(line, figures.line_style(line)["linestyle"]) for line in section(family).lines]
        for name in engine_names():
            dashes = [style for line, style in styles if line.result.job.engine == name]
            assert len(set(dashes)) == len(dashes), (family, name)
        assert "-" in (counted := [style for line, style in styles if line.counts]), family
        assert not {style for line, style in styles if not line.counts} & set(counted), family


@both
def test_the_curves_have_the_markers_that_the_legend_shows(draw):
    root = ElementTree.fromstring(drawn("ball-to-rest", draw))
    (axes,) = (group for group in root.iter(f"{SVG}g") if group.get("id", "").endswith("-axes_1"))
    used = Counter(its["fill"] for _, its in markers(axes))
    for colour in ("#1b1b1b", "#0072b2", "#d55e00"):  # the tuned ones, whose markers are filled
        assert used[colour] >= 2


@both
def test_tuned_curves_lie_on_top_of_all_others(draw):
    root = ElementTree.fromstring(drawn("ball-to-rest", draw))
    (axes,) = (group for group in root.iter(f"{SVG}g") if group.get("id", "").endswith("-axes_1"))
    colours = {entry.colour for entry in legend(drawn("ball-to-rest", draw))}
    curves = [path for path in axes.iter(f"{SVG}path") if path.get("clip-path") and style(path)["stroke"] in colours]
    dashed = ["stroke-dasharray" in style(curve) for curve in curves]
    assert dashed == [True] * 7 + [False, True, False, False, False]  # what counts is whole; by hand, the exact method


def test_an_engine_from_a_file_is_drawn_in_a_style_of_its_own():
    shown = results("ball-to-rest")
    (found,) = sections([*shown, replace(shown[0], job=Job("ball-to-rest", "toy.py", "tuned"), title="a toy")])
    *known, toy = legend(figures.trajectories(found))
    assert toy.label == "a toy, tuned"
    assert toy.marker not in {entry.marker for entry in known}
    assert toy.colour not in {entry.colour for entry in known}


def test_titles_and_units_are_text_in_the_figures():
    family = catalogue()["ball-to-rest"]
    curve, study = (
        "".join(ElementTree.fromstring(drawn(family.name, draw)).itertext())
        for draw in (figures.trajectories, figures.convergence)
    )
    for text in (family.curve.title, family.curve.y_label, "time, s"):
        assert text in curve
    for text in ("time of rest", "e=0.5", "timestep, s", "root mean square error, s", "order 1.00"):
        assert text in study


def test_labels_of_an_axis_keep_the_digits_that_tell_them_apart():
    times = tuple(0.01 * step for step in range(200))
    svg = figures.trajectories(alone(series=Series(times, tuple(0.07 + 0.004 * time for time in times))))
    labels = [text for text in ElementTree.fromstring(svg).itertext() if re.fullmatch(r"0\.07\d*", text)]
    assert len(labels) > 3
    assert len(set(labels)) == len(labels)


def test_markup_in_a_title_cannot_break_the_figure():
    svg = figures.trajectories(alone(title='<b>ours</b> & "theirs"'))
    assert legend(svg)[0].label == '<b>ours</b> & "theirs", exact'


# Lines that are missing, short or all rounding


def test_without_a_curve_there_is_no_figure():
    assert figures.trajectories(section(change=lambda it: replace(it, series=None))) == ""
    assert figures.convergence(section(change=lambda it: replace(it, convergence=None))) == ""


@both
def test_lines_without_numbers_are_left_out_of_the_figure(draw):
    def only_mujoco(result: JobResult) -> JobResult:
        return result if result.job.engine == "mujoco" else replace(result, series=None, convergence=None)

    names = [entry.label.partition(": ")[0] for entry in legend(draw(section(change=only_mujoco)))]
    assert names == ["MuJoCo, tuned", "MuJoCo, spring", "MuJoCo, stock"]


@pytest.mark.parametrize("series", [Series((), ()), Series((0.0,), (1.0,)), Series((0.0, 1.0), (2.0, 2.0))])
def test_a_curve_of_few_points_or_none_is_drawn_anyway(series):
    assert [entry.label for entry in legend(figures.trajectories(alone(series=series)))] == ["hand-written, exact"]


@pytest.mark.parametrize(
    ("study", "said"),
    [
        (Errors((1e-3,), (0.1,), None), "too few timesteps"),
        pytest.param(Errors(STEPS, (0.0, 0.0, 0.0, 0.0), None), "rounding, 0 s", marks=pytest.mark.slow),
        (Errors(STEPS, (1e-16, 2e-16, 0.0, 3e-16), None), "rounding, <1 ns"),
        (Errors(STEPS, (0.4, 0.2, 0.1, 0.0), 1.0), "order 1.00"),
    ],
)
def test_errors_that_a_logarithm_cannot_show_are_drawn_anyway(study, said):
    assert [entry.label for entry in legend(figures.convergence(alone(convergence=study)))] == [
        f"hand-written, exact: {said}"
    ]


def test_errors_of_rounding_are_drawn_on_the_lower_edge():
    rounding = Errors(STEPS, (1e-16, 2e-16, 1e-16, 3e-16), None)
    exact, *others = results("ball-to-rest")
    (found,) = sections([replace(exact, convergence=rounding), *others])
    root = ElementTree.fromstring(figures.convergence(found))
    (axes,) = (group for group in root.iter(f"{SVG}g") if group.get("id", "").endswith("-axes_1"))
    heights: dict[str, list[float]] = {}
    for use, its in markers(axes):
        heights.setdefault(its["stroke"], []).append(float(use.get("y")))
    flat, *sloped = sorted(heights["#1b1b1b"], reverse=True)[:4], heights["#0072b2"], heights["#d55e00"]
    assert max(flat) == min(flat), "four points in a line, downmost in the picture"
    assert all(max(line) < min(flat) for line in sloped)
    assert all(max(line) - min(line) > 50 for line in sloped)  # points of 281: three octaves fill a good part of it


def test_logarithmic_axes_have_plain_powers_of_ten():
    root = ElementTree.fromstring(drawn("ball-to-rest", figures.convergence))
    texts = {text.text for text in root.iter(f"{SVG}text") if text.text}
    assert "10⁻³" in texts
    assert not any("$" in text or "mathdefault" in text for text in texts)
    assert all(re.fullmatch(r"([2-9]·)?10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", text) for text in texts if text[0].isdigit())
