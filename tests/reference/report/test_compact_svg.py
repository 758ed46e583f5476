"""Figures in fewer bytes show the same."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np

from reference.report.compact_svg import compact

WAY = np.cumsum(np.random.default_rng(5).normal(size=(400, 2)), axis=0) * 7.31 + 100
LINE = "M " + "L ".join(f"{x:.2f} {y:.2f} \n" for x, y in WAY)
SVG = f"""<svg xmlns="http://www.w3.org/2000/svg">
 <g>
  <g>
   <path d="{LINE}" clip-path="url(#clip)"/>
  </g>
 </g>
 <g style="opacity: 1">
  <text style="font-family: 'DejaVu Sans', sans-serif; text-anchor: end" transform="rotate(-0 1 2)">two  words</text>
 </g>
 <clipPath id="clip"/>
</svg>"""


def test_the_points_of_a_long_line_stay_within_a_twentieth_of_a_point():
    root = ElementTree.fromstring(compact(SVG))
    start, steps = root.find(".//{*}path").get("d").split("l")
    numbers = [float(number) for number in re.findall(r"-?(?:\d+\.?\d*|\.\d+)", f"{start} {steps}")]
    places = np.cumsum(np.reshape(numbers, (-1, 2)), axis=0)
    kept = np.concatenate([[True], np.any(np.diff(np.rint(WAY * 10), axis=0), axis=1)])
    np.testing.assert_allclose(places, WAY[kept], atol=0.0551)  # half a tenth, and half a hundredth of the text


def test_groups_without_content_are_removed_and_others_stay():
    root = ElementTree.fromstring(compact(SVG))
    assert [group.get("style") for group in root.findall(".//{*}g")] == ["opacity: 1"]
    assert [text.text for text in root.findall(".//{*}text")] == ["two  words"]
    assert root.find("{*}clipPath").get("id") == "clip"


def test_markers_of_one_style_have_it_in_their_group_and_others_keep_their_own():
    def line(*fills: str) -> str:
        uses = "".join(f'<use href="#m" x="{place}" style="fill: {fill}"/>' for place, fill in enumerate(fills))
        return f'<g clip-path="url(#c)">{uses}</g>'

    groups = list(ElementTree.fromstring(compact(f"<svg>{line('red', 'red')}{line('red', 'blue')}</svg>")))
    assert [group.get("style") for group in groups] == ["fill: red", None]
    assert [[use.get("style") for use in group] for group in groups] == [[None, None], ["fill: red", "fill: blue"]]
    assert [[use.get("x") for use in group] for group in groups] == [["0", "1"]] * 2


def test_ticks_that_follow_each_other_are_one_path_in_the_same_places():
    tick = '<defs><path id="m3" d="M 0 0 \nL 0 2 \n" style="stroke: #000000"/></defs>'
    uses = [f'<use xlink:href="#m3" x="{x}" y="197.59"/>' for x in (1.5, 2, 30.25)]
    head = '<svg xmlns:xlink="http://www.w3.org/1999/xlink">'
    root = ElementTree.fromstring(compact(f"{head}{tick}<g>{uses[0]}</g><g>{uses[1]}</g><text>1</text>{uses[2]}</svg>"))
    assert [each.tag for each in root] == ["defs", "path", "text", "use"]
    assert root[1].attrib == {"d": "M1.5 197.59l0 2M2 197.59l0 2", "style": "stroke: #000000"}
