"""The files of a report: complete, readable again, and the same bytes for the same comparison."""

from __future__ import annotations

import csv
import importlib.metadata
import json
import os
import pickle
import re
import subprocess
import sys
from dataclasses import fields, replace
from pathlib import Path

import pytest

from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.engines import load_engine
from reference.errors import InvalidInput
from reference.recording.files import content_of
from reference.recording.reading import recall
from reference.report.files import write
from reference.report.row_files import read_rows, rows_csv, rows_json
from reference.report.staging import staged
from reference.running.study import run_job

GOOD = Job("ball-to-rest", "handwritten", "exact", ("e=0.5",))
STUDIED = Job("parting-ball", "handwritten", "exact", ("v=0.1",), with_studies=True)
JOBS = [
    GOOD,
    replace(GOOD, profile="step"),
    Job("sliding-slab", "handwritten", "step", ("μ=0.7,v=1",)),
    replace(GOOD, profile="slide", cases=("e=0.5", "e=0.8")),
    STUDIED,
    replace(STUDIED, profile="step"),
]
"""Quick ones: some with their plotted case, two with studies."""
BY_TABLE = (0, 3, 1, 2, 4, 5)
"""Their order in a report: family by family as they are taught, tuned first and stock last."""
ENOUGH = 60.0  # s: any honest job here takes one, on a busy machine too


@pytest.fixture(scope="module")
def results() -> list[JobResult]:
    """Real results."""
    return [run_job(job) for job in JOBS]


@pytest.fixture(scope="module")
def report(results, tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("report")
    write(results, folder)
    return folder


def content(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


# What is written


def test_a_report_consists_of_page_rows_timings_provenance_and_figures(report):
    assert {name.replace(os.sep, "/") for name in content(report)} == {
        "index.html",
        "rows.json",
        "rows.csv",
        "pairs.csv",
        "timings.json",
        "provenance.json",
        "figures/ball-to-rest-trajectories.svg",
        "figures/parting-ball-trajectories.svg",
        "figures/parting-ball-convergence.svg",
    }


def test_the_figures_beside_the_page_are_those_in_it(report):
    page = (report / "index.html").read_text(encoding="utf-8")
    for path in (report / "figures").iterdir():
        assert path.read_text(encoding="utf-8") in page


@pytest.mark.parametrize(
    ("name", "schema", "version"),
    [
        ("rows.json", "collisions-lab/rows", 3),
        ("timings.json", "collisions-lab/timings", 1),
        ("provenance.json", "collisions-lab/provenance", 1),
    ],
)
def test_every_file_of_data_names_its_schema_and_version(name, schema, version, report):
    data = json.loads((report / name).read_text(encoding="utf-8"))
    assert list(data)[:2] == ["schema", "version"]
    assert (data["schema"], data["version"]) == (schema, version)


def test_the_time_of_each_job_is_kept_apart_from_the_rows(report, results):
    times = json.loads((report / "timings.json").read_text(encoding="utf-8"))["seconds"]
    used = ("seconds", "processor_seconds")
    assert {(it["family"], it["engine"], it["profile"]): [it[name] for name in used] for it in times} == {
        (it.job.family, it.job.engine, it.job.profile): pytest.approx([getattr(it, name) for name in used], abs=5e-4)
        for it in results
    }
    assert not any(it["cached"] for it in times)
    assert all(0 < it["processor_seconds"] <= it["seconds"] + 0.02 for it in times)  # two ticks of another clock
    assert "seconds" not in (report / "rows.json").read_text(encoding="utf-8")


def test_provenance_has_date_machine_and_versions(report):
    told = json.loads((report / "provenance.json").read_text(encoding="utf-8"))
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\+00:00", told["made"])
    assert told["engines"].keys() == {"hand-written"}
    assert told["packages"].keys() == {"numpy", "matplotlib"}
    assert told["python"] == ".".join(map(str, sys.version_info[:3]))
    assert told["processors"] == os.cpu_count()
    assert told["platform"]


def test_lines_end_the_same_way_on_every_system(report):
    assert all(b"\r" not in data for data in content(report).values())


# Rows


def test_rows_are_read_back_as_they_were_written(report, results):
    rows = [row for place in BY_TABLE for row in results[place].rows]
    read = read_rows(report / "rows.json")
    assert read == rows
    assert [row.settings for row in read] == [row.settings for row in rows]  # which equality leaves out
    assert all(isinstance(row.verdict, Verdict) for row in read)


@pytest.mark.parametrize("verdict", Verdict)
def test_a_row_of_any_verdict_is_read_back_to_the_last_digit(verdict, tmp_path):
    odd = Row(
        "f", "μ=½", "odd.py", "tuned", "", "m/s", verdict, note='a "note"\nof <two> lines', settings="stiffness ∞"
    )
    whole = replace(odd, measured=0.1 + 0.2, spread=1e-300, expected=-0.0, tolerance=1e300, shift=5e-324, scale=1 / 3)
    job = Job("ball-to-rest", "odd.py", "tuned")
    (tmp_path / "rows.json").write_text(rows_json([JobResult(job, "", "", (odd, whole))]), encoding="utf-8")
    assert [repr(row) for row in read_rows(tmp_path / "rows.json")] == [repr(odd), repr(whole)]  # to the last digit


def test_rows_contain_only_standard_json_numbers(report):
    def refuse(name: str) -> float:
        raise AssertionError(f"{name} is not JSON")

    data = json.loads((report / "rows.json").read_text(encoding="utf-8"), parse_constant=refuse)
    assert len(data["rows"]) == 4 + 8 + 4 + 4 + 5 + 5
    assert data["rows"][0].keys() == {field.name for field in fields(Row)}


def test_names_are_not_escaped_in_the_rows(report):
    assert '"μ=0.7,v=1"' in (report / "rows.json").read_text(encoding="utf-8")


def test_convergence_studies_are_written_beside_the_rows(report, results):
    studies = json.loads((report / "rows.json").read_text(encoding="utf-8"))["convergence"]
    assert [(it["engine"], it["profile"]) for it in studies] == [("handwritten", "exact"), ("handwritten", "step")]
    for study, result in zip(studies, results[4:], strict=True):
        assert study["family"] == "parting-ball"
        assert study["timesteps"] == list(result.convergence.timesteps)
        assert study["errors"] == list(result.convergence.errors)
        assert study["order"] == result.convergence.order


GIVEN = '{"family": "f", "case": "c", "engine": "e", "profile": "p", "quantity": "q", "unit": "m"'


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("no JSON", "is not JSON"),
        ("", "is not JSON"),
        ("[]", "is None version None; this program reads collisions-lab/rows version 3"),
        ('{"rows": []}', "is None version None; this program reads collisions-lab/rows version 3"),
        ('{"schema": "collisions-lab/rows", "version": 1, "rows": []}', "is collisions-lab/rows version 1; this"),
        ('{"schema": "collisions-lab/timings", "version": 1}', "is collisions-lab/timings version 1; this program"),
        ('{"schema": "collisions-lab/rows", "version": 3}', "cannot be read: 'rows'"),
        ('{"schema": "collisions-lab/rows", "version": 3, "rows": 3}', "cannot be read"),
        ('{"schema": "collisions-lab/rows", "version": 3, "rows": [3]}', "cannot be read"),
        ('{"schema": "collisions-lab/rows", "version": 3, "rows": [{}]}', "cannot be read: 'verdict'"),
        (GIVEN + ', "verdict": "good"}', "cannot be read: 'good' is not a valid Verdict"),
        (GIVEN + ', "verdict": "pass", "colour": 3}', "unexpected keyword argument 'colour'"),
        ('{"verdict": "pass"}', "missing 6 required positional arguments"),
        (GIVEN + ', "verdict": "pass", "measured": NaN}', "measured is nan"),
        (GIVEN + ', "verdict": "pass", "measured": "much"}', "measured is 'much'"),
    ],
)
def test_a_file_without_rows_is_refused_by_name(text, said, tmp_path):
    path = tmp_path / "rows.json"
    is_row = '"verdict"' in text
    whole = f'{{"schema": "collisions-lab/rows", "version": 3, "rows": [{text}]}}' if is_row else text
    path.write_text(whole, encoding="utf-8")
    with pytest.raises(InvalidInput) as refused:
        read_rows(path)
    assert said in str(refused.value)
    assert path.name in str(refused.value)


def test_a_file_that_cannot_be_opened_or_decoded_is_refused(tmp_path):
    with pytest.raises(InvalidInput, match=r"cannot read .*missing\.json.*: No such file"):
        read_rows(tmp_path / "missing.json")
    with pytest.raises(InvalidInput, match="cannot read"):
        read_rows(tmp_path)
    with pytest.raises(InvalidInput, match="cannot read '/dev/null': not a regular file"):  # another may have no end
        read_rows(Path("/dev/null"))
    (tmp_path / "latin").write_bytes("μ".encode("latin-1", errors="replace") + b"\xb5")
    with pytest.raises(InvalidInput, match="is not JSON"):
        read_rows(tmp_path / "latin")


def test_the_csv_table_has_the_same_rows_with_their_errors(report):
    rows = read_rows(report / "rows.json")
    with (report / "rows.csv").open(encoding="utf-8", newline="") as file:
        table = list(csv.DictReader(file))
    assert len(table) == len(rows)
    for line, row in zip(table, rows, strict=True):
        assert line.keys() == {*(field.name for field in fields(Row)), "error", "relative_error"}
        assert None not in line.values()
        for name in ("family", "case", "engine", "profile", "quantity", "verdict", "note", "settings"):
            assert line[name] == str(getattr(row, name))
        for name in ("measured", "expected", "tolerance", "scale", "error", "relative_error"):
            value = getattr(row, name)
            assert line[name] == "" if value is None else float(line[name]) == value


def test_recorded_rows_say_which_version_was_recorded_and_when(report, tmp_path):
    made = content_of("mujoco", "parting-ball")["made"]
    result = recall(Job("parting-ball", "mujoco", "tuned"))
    (tmp_path / "rows.json").write_text(rows_json([result]), encoding="utf-8")
    table = csv.DictReader(rows_csv([result]).splitlines())
    in_json = {(row.engine_version, row.recorded_on) for row in read_rows(tmp_path / "rows.json")}
    in_csv = {(line["engine_version"], line["recorded_on"]) for line in table}
    assert in_json == in_csv == {(made["version"], made["date"])}
    assert {row.adapter_version for row in read_rows(tmp_path / "rows.json")} == {""}, "nobody kept it"


def test_rows_that_ran_here_say_the_versions_of_engine_and_adapter(report):
    lab = importlib.metadata.version("collisions-lab")
    found = {(row.engine, row.engine_version, row.adapter_version) for row in read_rows(report / "rows.json")}
    assert found == {(name, load_engine(name).version(), lab) for name, *_ in found}


def test_commas_quotes_and_line_breaks_stay_in_their_cell():
    note = 'a "note", of\ntwo lines'
    row = Row("f", "μ=0.7,v=1", "odd.py", "tuned", "", "", Verdict.CRASHED, note=note)
    text = rows_csv([JobResult(Job("f", "odd.py", "tuned"), "", "", (row,))])
    heading, line = csv.reader(text.splitlines(keepends=True))
    assert dict(zip(heading, line, strict=True))["note"] == note


# The same comparison, the same bytes

ELSEWHERE = """
import pickle
import sys
from pathlib import Path
from reference.report.files import write
from reference.running.study import run_job

write([run_job(job) for job in reversed(pickle.loads(Path(sys.argv[1]).read_bytes()))], Path(sys.argv[2]))
"""


@pytest.mark.slow
def test_another_process_writes_the_same_bytes_from_another_order(report, tmp_path):
    jobs, out = tmp_path / "jobs", tmp_path / "out"
    jobs.write_bytes(pickle.dumps(JOBS))
    out.mkdir()
    environment = os.environ | {"PYTHONHASHSEED": "1", "PYTHONUTF8": "1"}  # sets come in another order
    command = [sys.executable, "-c", ELSEWHERE, str(jobs), str(out)]
    subprocess.run(command, env=environment, timeout=ENOUGH, check=True)
    first, second = content(report), content(out)
    assert first.keys() == second.keys()
    assert len(first) == 9
    differing = {name for name in first if first[name] != second[name]}
    assert differing <= {"timings.json", "provenance.json"}


def test_a_second_report_replaces_the_first(report, results, tmp_path):
    out = tmp_path / "out"
    for chosen in (results[:1], results):
        with staged(out) as folder:
            write(chosen, folder)
    timeless = {name: data for name, data in content(report).items() if name not in ("timings.json", "provenance.json")}
    assert content(out).keys() == content(report).keys()
    assert content(out).items() >= timeless.items()
