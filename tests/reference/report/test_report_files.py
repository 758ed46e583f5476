"""The report's files: whole or not at all, readable again, and the same bytes for the same comparison."""

from __future__ import annotations

import csv
import json
import os
import pickle
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields, replace
from pathlib import Path

import pytest

from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import ALL_CASES, Row, Verdict
from reference.errors import InvalidInput
from reference.report.files import write
from reference.report.row_files import read_rows, rows_csv, rows_json
from reference.report.staging import staged
from reference.running.jobs import run_all, run_one
from reference.running.study import SCENARIOS, run_job

GOOD = Job("ball-to-rest", "handwritten", "tuned", ("e=0.5",))
STUDIED = Job("parting-ball", "handwritten", "tuned", ("v=0.1",), with_studies=True)
JOBS = [
    GOOD,
    replace(GOOD, profile="stock"),
    Job("sliding-slab", "handwritten", "stock", ("μ=0.7,v=1",)),
    replace(GOOD, profile="slide", cases=("e=0.5", "e=0.8")),
    STUDIED,
    replace(STUDIED, profile="stock"),
]
"""Quick ones: some with their plotted case, two with studies."""
BY_TABLE = (0, 3, 1, 2, 4, 5)
"""Their order in a report: family by family as they are taught, tuned first and stock last."""
ENOUGH = 60.0  # s: any honest job here takes one, on a busy machine too
ENGINE_FILE = """
import os, time

from reference.engines.base import Engine, Method
from reference.scene.settings import Settings
from reference.scene.trajectory import Recorder


class Odd(Engine):
    name, title, package = "odd", {title!r}, {package!r}

    def settings(self, scenario, profile):
        self.check_profile(scenario, profile)
        return Settings(0.01)

    def method(self, scenario, settings):
        return Method("at step")

    def run(self, scenario, settings):
        recorder = Recorder(self.name, scenario, settings)
        state = [n for b in scenario.bodies for n in (*b.position, *b.orientation, *b.velocity, *b.angular_velocity)]
        recorder.sample(state)
        {body}
        return recorder.trajectory()


ENGINE = Odd
"""


def odd_job(folder: Path, title: str, body: str = "pass", package: str | None = None) -> Job:
    """A job of an engine in a file of its own; `body` is a line that its run does."""
    path = folder / f"{re.sub('[^a-z]', '_', title)}.py"
    path.write_text(ENGINE_FILE.format(title=title, body=body, package=package), encoding="utf-8")
    return Job("ball-to-rest", str(path), "tuned", ("e=0.5",))


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
    ("name", "schema"),
    [
        ("rows.json", "collisions-lab/rows"),
        ("timings.json", "collisions-lab/timings"),
        ("provenance.json", "collisions-lab/provenance"),
    ],
)
def test_every_file_of_data_names_its_schema_and_version(name, schema, report):
    data = json.loads((report / name).read_text(encoding="utf-8"))
    assert list(data)[:2] == ["schema", "version"]
    assert (data["schema"], data["version"]) == (schema, 1)


def test_the_time_of_each_job_is_kept_apart_from_the_rows(report, results):
    times = json.loads((report / "timings.json").read_text(encoding="utf-8"))["seconds"]
    assert {(it["family"], it["engine"], it["profile"]): it["seconds"] for it in times} == {
        (it.job.family, it.job.engine, it.job.profile): pytest.approx(it.seconds, abs=5e-4) for it in results
    }
    assert not any(it["cached"] for it in times)
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
    assert [(it["engine"], it["profile"]) for it in studies] == [("handwritten", "tuned"), ("handwritten", "stock")]
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
        ("[]", "is None version None; this program reads collisions-lab/rows version 1"),
        ('{"rows": []}', "is None version None; this program reads collisions-lab/rows version 1"),
        ('{"schema": "collisions-lab/rows", "version": 2, "rows": []}', "is collisions-lab/rows version 2; this"),
        ('{"schema": "collisions-lab/timings", "version": 1}', "is collisions-lab/timings version 1; this program"),
        ('{"schema": "collisions-lab/rows", "version": 1}', "cannot be read: 'rows'"),
        ('{"schema": "collisions-lab/rows", "version": 1, "rows": 3}', "cannot be read"),
        ('{"schema": "collisions-lab/rows", "version": 1, "rows": [3]}', "cannot be read"),
        ('{"schema": "collisions-lab/rows", "version": 1, "rows": [{}]}', "cannot be read: 'verdict'"),
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
    whole = f'{{"schema": "collisions-lab/rows", "version": 1, "rows": [{text}]}}' if is_row else text
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


def test_another_process_writes_the_same_bytes_from_another_order(report, tmp_path):
    jobs, out = tmp_path / "jobs", tmp_path / "out"
    jobs.write_bytes(pickle.dumps(JOBS))
    out.mkdir()
    environment = os.environ | {"PYTHONHASHSEED": "1", "PYTHONUTF8": "1"}  # sets come in another order
    command = [sys.executable, "-c", ELSEWHERE, str(jobs), str(out)]
    subprocess.run(command, env=environment, timeout=ENOUGH, check=True)
    first, second = content(report), content(out)
    assert first.keys() == second.keys()
    assert len(first) == 8
    differing = {name for name in first if first[name] != second[name]}
    assert differing <= {"timings.json", "provenance.json"}


# Staging


@pytest.fixture
def earlier(tmp_path) -> Path:
    """A folder with a good report in it, and with something of somebody else's."""
    out = tmp_path / "out"
    (out / "figures").mkdir(parents=True)
    for name in ("index.html", "rows.json", "figures/a.svg", "notes.txt", "figures/mine.png"):
        (out / name).write_text(f"earlier {name}")
    return out


def test_staged_files_are_moved_only_when_all_went_well(earlier):
    before = content(earlier)
    with staged(earlier) as folder:
        assert folder.parent == earlier, "on the same disk, so that a file can be replaced in one go"
        (folder / "index.html").write_text("new page")
        (folder / "figures").mkdir()
        (folder / "figures" / "b.svg").write_text("new figure")
        assert {name: content(earlier)[name] for name in before} == before
    new = {"index.html": b"new page", os.path.join("figures", "b.svg"): b"new figure"}
    assert content(earlier) == before | new
    assert not folder.exists()


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt, SystemExit])
def test_a_report_that_is_broken_off_leaves_the_earlier_one_unchanged(error, earlier):
    before, names = content(earlier), sorted(os.listdir(earlier))
    with pytest.raises(error), staged(earlier) as folder:  # noqa: PT012  half of it has to be written before it fails
        (folder / "index.html").write_text("half a pa")
        raise error
    assert content(earlier) == before
    assert sorted(os.listdir(earlier)) == names


def test_a_report_that_is_broken_off_leaves_no_new_folder(tmp_path):
    def break_off() -> None:
        with staged(tmp_path / "a" / "b" / "c") as folder:
            assert folder.is_dir()
            raise RuntimeError

    with pytest.raises(RuntimeError):
        break_off()
    assert os.listdir(tmp_path) == []
    (tmp_path / "a").mkdir()
    with pytest.raises(RuntimeError):
        break_off()
    assert (tmp_path / "a").is_dir(), "a folder that was there stays"
    assert os.listdir(tmp_path / "a") == []


def test_the_page_is_replaced_after_all_other_files(earlier, monkeypatch):
    moved, replace_one = [], os.replace

    def watched(source: Path, target: Path) -> None:
        moved.append(target.relative_to(earlier).as_posix())
        replace_one(source, target)

    monkeypatch.setattr("reference.report.staging.os.replace", watched)
    with staged(earlier) as folder:
        (folder / "zebras").mkdir()
        for name in ("index.html", "a.json", "zebras/index.html", "z.json"):
            (folder / name).write_text("new")
    assert sorted(moved) == ["a.json", "index.html", "z.json", "zebras/index.html"]
    assert moved[-1] == "index.html"
    assert (earlier / "index.html").read_text() == (earlier / "zebras" / "index.html").read_text() == "new"


def test_a_second_report_replaces_the_first(report, results, tmp_path):
    out = tmp_path / "out"
    for chosen in (results[:1], results):
        with staged(out) as folder:
            write(chosen, folder)
    timeless = {name: data for name, data in content(report).items() if name not in ("timings.json", "provenance.json")}
    assert content(out).keys() == content(report).keys()
    assert content(out).items() >= timeless.items()


def test_an_unusable_folder_for_a_report_is_refused(tmp_path):
    occupied = tmp_path / "occupied"
    occupied.write_text("mine")
    for out in (occupied, occupied / "deeper", occupied / "still" / "deeper", tmp_path / ("long" * 100)):
        with pytest.raises(InvalidInput, match=r"cannot write the report to .*; choose another --out"), staged(out):
            raise AssertionError("found out before anything runs")
    assert occupied.read_text() == "mine"
    assert os.listdir(tmp_path) == ["occupied"]


def test_a_folder_in_the_way_of_a_file_is_refused_without_leftovers(tmp_path):
    out = tmp_path / "out"
    (out / "index.html").mkdir(parents=True)
    (out / "index.html" / "mine").write_text("mine")

    def try_it() -> None:
        with staged(out) as folder:
            (folder / "index.html").write_text("new")

    with pytest.raises(InvalidInput, match="cannot write the report"):
        try_it()
    assert content(out) == {os.path.join("index.html", "mine"): b"mine"}
    assert os.listdir(out) == ["index.html"]


# Runs that die, hang or give nothing

MESSAGE = "<script>alert('moon')</script> & co"


@pytest.fixture(scope="module")
def with_odd_ones(results, tmp_path_factory) -> tuple[Path, list[JobResult]]:
    """A report of good results beside engines that crash, raise, hang, give NaN or are not installed."""
    folder, out = tmp_path_factory.mktemp("engines"), tmp_path_factory.mktemp("report")
    jobs = [
        odd_job(folder, "crashing", "os._exit(3)"),
        odd_job(folder, "raising", f"raise RuntimeError({MESSAGE!r})"),
        odd_job(folder, "not a number", "recorder.sample([float('nan')] * len(state))"),
        odd_job(folder, "missing", package="no_such_package"),
    ]
    with ThreadPoolExecutor(2) as executor:
        found = list(run_all(jobs, SCENARIOS, executor, ENOUGH))
    # 1 s: whatever the limit, it hangs for longer; what it is here only makes the test quick.
    found.append(run_one(odd_job(folder, "hanging", "time.sleep(600)"), SCENARIOS, 1.0))
    write([*found, *results], out)
    return out, found


SAID = {
    "crashing": (Verdict.CRASHED, "its process died (exit code 3)"),
    "raising": (Verdict.CRASHED, f"RuntimeError: {MESSAGE}"),
    "not a number": (Verdict.CRASHED, "are not finite from t = 0.01 s on"),
    "missing": (Verdict.NOT_AVAILABLE, "pip install no_such_package"),
    "hanging": (Verdict.CRASHED, "no answer within 1 s"),
}


@pytest.mark.parametrize("title", SAID)
def test_a_run_without_an_answer_is_one_row_of_a_finished_report(title, with_odd_ones, results):
    out, found = with_odd_ones
    (result,) = (result for result in found if result.title == title)
    verdict, message = SAID[title]
    (row,) = result.rows
    assert (row.verdict, row.case in (ALL_CASES, "e=0.5")) == (verdict, True)
    assert message in row.note
    rows = read_rows(out / "rows.json")
    assert row in rows
    assert len(rows) == len(found) + sum(len(result.rows) for result in results)


@pytest.mark.parametrize("title", SAID)
def test_the_page_shows_why_a_run_gave_no_answer_as_plain_text(title, with_odd_ones):
    page = (with_odd_ones[0] / "index.html").read_text(encoding="utf-8")
    verdict, message = SAID[title]
    escaped = message.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace("'", "&#39;")
    assert f"{title}, tuned" in page
    assert re.search(rf"{verdict}: [^<]*{re.escape(escaped)}", page)
    assert "<script>alert" not in page


def test_the_page_lists_as_compared_only_engines_that_ran(with_odd_ones):
    page = (with_odd_ones[0] / "index.html").read_text(encoding="utf-8")
    (opening,) = re.findall(r"run by ([^.]*)\.", page)
    assert opening.startswith("hand-written code")
    assert not [title for title in ("crashing", "missing", "hanging") if title in opening]


def test_a_report_of_crashes_alone_is_written(with_odd_ones, tmp_path):
    _, found = with_odd_ones
    write(found, tmp_path)
    assert len(read_rows(tmp_path / "rows.json")) == len(found)
    assert os.listdir(tmp_path / "figures") == []
    assert "0 of 5 checks" in (tmp_path / "index.html").read_text(encoding="utf-8")


def test_nan_is_never_written_into_the_rows():
    bad = Row("f", "c", "e", "tuned", "q", "m", Verdict.PASS)
    object.__setattr__(bad, "measured", float("nan"))  # which a row refuses when it is made
    with pytest.raises(ValueError, match="not JSON compliant"):
        rows_json([JobResult(GOOD, "", "", (bad,))])
