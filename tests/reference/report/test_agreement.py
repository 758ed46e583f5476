"""The matrix of who agrees with whom, as text."""

from __future__ import annotations

import csv
import itertools
import json

import pytest

from reference.catalogue.apart import why_apart
from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.report.agreement import Matrix, as_content, by_scenario, pairs_csv, sentence
from reference.report.sections import sections

CASE = "3 touching"
ENGINES = {
    ("handwritten", "exact"): (0.0, Verdict.SHOWN),
    ("pybullet", "tuned"): (-1 / 3, Verdict.PASS),
    ("mujoco", "tuned"): (-0.3333, Verdict.PASS),
    ("dart", "stock"): (None, Verdict.FAIL),
}
ROWS = [
    Row("cradle", CASE, engine, profile, "first", "", verdict, measured)
    for (engine, profile), (measured, verdict) in ENGINES.items()
]
SECTION = sections([JobResult(Job("cradle", row.engine, row.profile), row.engine, "", (row,)) for row in ROWS])[0]


def test_each_implementation_is_compared_with_those_above_it():
    matrix = Matrix.of(SECTION)
    assert matrix.titles == ("handwritten, exact", "pybullet, tuned", "mujoco, tuned", "dart, stock")
    texts = [[entry.text if entry else None for entry in entries] for entries in matrix.rows]
    assert texts == [[], ["≠ 1"], ["≠ 1", "✓"], ["≠ 1", "≠ 1", "≠ 1"]]
    assert [matrix.rows[1][0].title, matrix.rows[3][2].title] == [
        "1 of 1 numbers differ, most by 0.33 of the first speed in “first ball” (3 touching)",
        "1 of 1 numbers differ, one has no “first ball” (3 touching)",
    ]


def test_a_reason_is_listed_once_with_those_that_it_belongs_to():
    assert dict(Matrix.of(SECTION).whys) == {
        why_apart("cradle"): (),
        why_apart("cradle", "dart", "stock"): ("dart, stock",),
    }


def test_a_reason_that_names_its_implementation_has_no_label():
    told = [JobResult(line.result.job, "DART*", "", line.result.rows) for line in SECTION.lines[3:]]
    section = sections([*(line.result for line in SECTION.lines[:3]), *told])[0]
    assert dict(Matrix.of(section).whys)[why_apart("cradle", "dart", "stock")] == ()


def test_engines_of_ones_own_are_compared_by_their_files_and_not_by_the_names_of_their_classes():
    row = Row("cradle", CASE, "odd", "tuned", "first", "", Verdict.FAIL, 0.5, note="it is odd")
    own = [JobResult(Job("cradle", file, "tuned"), file, "", (row,)) for file in ("one.py", "other.py")]
    section = sections([*(line.result for line in SECTION.lines), *own])[0]
    matrix = Matrix.of(section)
    assert matrix.titles[-2:] == ("one.py, tuned", "other.py, tuned")
    assert [entry.text for entry in matrix.rows[-1]] == ["≠ 1"] * 4 + ["✓"]
    assert dict(matrix.whys)["it is odd"] == ("one.py, tuned", "other.py, tuned")
    assert "one.py (tuned)" in by_scenario([section])["cradle"].farthest


def test_counted_implementations_alone_are_summed_up():
    assert sentence(SECTION.pairs) == (
        "Compared with each other, 1 of 3 pairs of numbers are alike, 0 differ as their methods say, and 2 are apart."
    )
    assert sentence(SECTION.pairs[2:3]) == ""  # with DART as installed


def test_files_hold_every_pair_and_the_counts_of_each_two():
    table = list(csv.DictReader(pairs_csv(SECTION.pairs).splitlines()))
    names = [f"{engine} {profile}" for engine, profile in ENGINES]
    of_each = [
        [f"{line[f'{which}_engine']} {line[f'{which}_profile']}" for which in ("first", "second")] for line in table
    ]
    assert of_each == list(map(list, itertools.combinations(names, 2)))
    assert [float(line["difference"]) for line in table if line["difference"]] == pytest.approx(
        [1 / 3, 0.3333, -1 / 3e4]
    )
    content = json.loads(json.dumps(as_content(SECTION.pairs)))
    assert [[" ".join(each[which].values()) for which in ("first", "second")] for each in content] == of_each
    assert [(each["alike"], each["apart"]) for each in content] == [(0, 1), (0, 1), (0, 1), (1, 0), (0, 1), (0, 1)]
    assert content[0]["whys"] == [why_apart("cradle")]


def test_the_two_that_are_farthest_apart_are_told_in_a_sentence():
    assert by_scenario([SECTION])["cradle"].in_words == (
        "With each other they do not agree: 2 of 3 pairs of their numbers are apart. Most of all, handwritten (exact)"
        " and pybullet (tuned) differ by 0.33 of the first speed in “first ball” (3 touching)."
    )
    assert by_scenario([SECTION])["cradle"].others == 3, "each with DART as installed"
