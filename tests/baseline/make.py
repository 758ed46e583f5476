"""Writes what people receive from the project into a folder, so that a later state can be compared with it.

    .venv/bin/python tests/baseline/make.py --out FOLDER --keep        # before a change
    .venv/bin/python tests/baseline/make.py --out OTHER --against FOLDER --submissions FOLDER/submissions

It takes the checkout in which it is started. The parts, each chosen by `--only`:

- `grades`: the grades of all kept submissions, as `collisions grade` writes them (`kept_submissions.py`);
- `files`: which files are in the wheel, the sdist, the students' releases and the bundles for other platforms, and a
  digest of each file that is not Python, where a refactoring changes nothing but the Python;
- `messages`: what the lab says to forty bad inputs (`bad_inputs.py`);
- `report`: rows.json and published.json of a live report.

Each JSON file in the folder is a group. `checksums.txt` has a line for each: its digest, with numbers rounded to six
significant digits, and the commit that it was made from. Check out that commit and run the same command to make the
files again. Numbers of a report are those of one kind of machine with all engines.

The examples that a test draws depend on the text of the submission and of the test, and wrong answers are put into the
solutions. With `--submissions`, the very files of the older baseline are graded, so that no other examples are drawn.

The grades take a quarter of an hour of processor time, files and messages two minutes, the report as long as always.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tarfile
import time
import zipfile
from collections.abc import Iterator, Mapping
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import bad_inputs
import kept_submissions

ROOT, HERE = Path.cwd(), Path(__file__).resolve().parent
CHECKSUMS, SUBMISSIONS = HERE / "checksums.txt", "submissions"
LEFT_OUT, TOTALS = {"schema", "identity", "tier", "missing"}, ("got", "possible", "points")
"""Of a grade: its identity has versions and digests of files, the tier and what is missing depend on the kernel.

Of a submission that answers by chance only the totals are kept.
"""
SECONDS = "15"
"""What a hostile submission may compute and sleep; many of them would use the 60 s that others have."""
RELEASES = {"all labs": (), "through impulse": ("--through", "impulse"), "impulse alone": ("--only", "impulse")}
PLATFORMS = {"gradescope": "bundle.zip", "classroom50": "bundle", "prairielearn": "bundle"}
NEAR = 1e-6
"""Numbers that differ by a smaller share are equal."""


class Maker:
    """Makes the parts. out: the folder of the baseline. work: for everything that is not kept."""

    def __init__(self, out: Path, work: Path) -> None:
        self.out, self.work = out, work
        self.environment = {
            **os.environ, "PYTHONPATH": str(ROOT), "COLLISIONS_CACHE": str(work / "cache"),
            "COLUMNS": "100", "NO_COLOR": "1", "TERM": "dumb",
        }  # fmt: skip

    def collisions(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Run a command of the lab, in a folder in which nothing else is."""
        return self.python("-m", "labs", *arguments, cwd=self.work)

    def python(self, *arguments: str, cwd: Path = ROOT) -> subprocess.CompletedProcess[str]:
        """Run the interpreter on the checkout."""
        command = [sys.executable, *arguments]
        return subprocess.run(command, cwd=cwd, env=self.environment, capture_output=True, text=True, check=False)

    def write(self, group: str, content: object) -> None:
        """Write a group; what differs from run to run or with each line that is moved has a placeholder."""
        path = self.out / f"{group}.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        text = json.dumps(content, ensure_ascii=False, indent=1, sort_keys=True) + "\n"
        text = text.replace(str(self.work), "FOLDER").replace(str(ROOT), "ROOT")
        text = re.sub(r"\bat 0x[0-9a-f]+", "at ADDRESS", re.sub(r"\.py:\d+", ".py:LINE", text))
        path.write_text(text, "utf-8", "backslashreplace")

    def grades(self, submissions: Path | None) -> None:
        """Grade the kept submissions of this checkout, or those of another baseline."""
        folder = self.out / SUBMISSIONS
        if submissions is None or submissions.resolve() != folder.resolve():
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(submissions, folder) if submissions else kept_submissions.write(ROOT, folder)
        for group in sorted(folder.iterdir()):
            self.write(f"grades/{group.name}", self._graded(group))

    def _graded(self, group: Path) -> dict[str, Any]:
        """Return the grades of a class by submission; of one that has none, the note that says why."""
        hostile, grades = group.name == kept_submissions.HOSTILE, self.work / group.name
        lab, seconds = (kept_submissions.HOSTILE_LAB, ("--seconds", SECONDS)) if hostile else (group.name, ())
        options = ("--lab", lab, "--out", str(grades), "--no-runs", "--jobs", "2")
        ended = self.collisions("grade", str(group.resolve()), *options, *seconds)
        if not (grades / "grades.csv").is_file():
            return {"the whole class": {"code": ended.returncode, "said": ended.stderr.splitlines()[-1:]}}
        with open(grades / "grades.csv", encoding="utf-8", newline="") as file:
            found: dict[str, Any] = {row["student_id"]: {"notes": row["notes"]} for row in csv.DictReader(file)}
        for path in grades.glob("students/*/grade.json"):
            grade = json.loads(path.read_text("utf-8"))
            student = grade["identity"]["student"]
            fields = TOTALS if student in kept_submissions.BY_CHANCE else grade.keys() - LEFT_OUT
            found[student] = {key: grade[key] for key in fields}
        print(f"  {group.name}: {len(found)} submissions", flush=True)
        return found

    def files(self) -> None:
        """List the files of everything that is given away."""
        if find_spec("hatchling") is None:
            target, pins = self.work / "hatchling", ROOT / "constraints.txt"
            self._done(self.python("-m", "pip", "install", "-q", "-c", str(pins), "--target", str(target), "hatchling"))
            self.environment["PYTHONPATH"] = os.pathsep.join([str(ROOT), str(target)])
        self._done(self.python("-m", "hatchling", "build", "-d", str(self.work / "dist")))
        (wheel,), (sdist,) = (self.work / "dist").glob("*.whl"), (self.work / "dist").glob("*.tar.gz")
        self.write("files/wheel", sorted(zipfile.ZipFile(wheel).namelist()))
        with tarfile.open(sdist) as archive:
            self.write("files/sdist", sorted(name.partition("/")[2] for name in archive.getnames()))
        found = {}
        for name, options in RELEASES.items():
            self._done(self.collisions("lab", "release", "--out", "release.zip", *options))
            found[name] = self._taken(self.work / "release.zip")
        self.write("files/release", found)
        labs = sorted(path.stem for path in (ROOT / "labs/notebooks").glob("*.ipynb"))
        for platform, name in PLATFORMS.items():
            found = {}
            for lab in labs:
                self._done(self.collisions("export", platform, "--lab", lab, "--out", name))
                taken = self._taken(self.work / name)
                found[lab] = {each.replace(f"collisions-{lab}", "collisions-LAB"): taken[each] for each in taken}
            self.write(f"files/{platform}", found)

    def _done(self, ended: subprocess.CompletedProcess[str]) -> None:
        if ended.returncode:
            raise SystemExit(f"{' '.join(ended.args)} ended with {ended.returncode}: {ended.stderr}")

    def _taken(self, place: Path) -> dict[str, str]:
        """Return the names of the files of an archive or a folder with digests, none of Python, and remove it."""
        if place.is_file():
            with zipfile.ZipFile(place) as archive:
                contents = {name: archive.read(name) for name in archive.namelist()}
            place.unlink()
        else:
            contents = {str(path.relative_to(place)): path.read_bytes() for path in place.rglob("*") if path.is_file()}
            shutil.rmtree(place)
        return {name: "" if name.endswith(".py") else digest(content)[:16] for name, content in contents.items()}

    def messages(self) -> None:
        """Write down what is said to bad inputs."""
        folder = self.work / "bad inputs"
        folder.mkdir()
        printed = self.python(str(HERE / "bad_inputs.py"))
        self._done(printed)
        said = bad_inputs.said_to_commands(folder, self.environment) | json.loads(printed.stdout)
        self.write("messages", said)

    def report(self, there: Path | None) -> None:
        """Take the numbers of a report that is there already, or make one."""
        folder = there or self.work / "report"
        if there is None:
            self.collisions("report", "--out", str(folder))  # ends with 1 if a verdict that counts has failed
        for name in ("rows", "published"):
            content = json.loads((folder / f"{name}.json").read_text("utf-8"))
            if content.get("unfinished"):
                raise SystemExit(f"{folder} is the first page of a report that has not finished")
            self.write(f"report/{name}", content)


def digest(content: bytes) -> str:
    """Return the SHA-256 of some bytes."""
    return hashlib.sha256(content).hexdigest()


def groups(folder: Path) -> dict[str, Any]:
    """Return the content of each group in the folder of a baseline."""
    paths = [path for path in sorted(folder.rglob("*.json")) if SUBMISSIONS not in path.relative_to(folder).parts]
    return {str(path.relative_to(folder).with_suffix("")): json.loads(path.read_text("utf-8")) for path in paths}


def rounded(content: Any) -> Any:
    """Return the content with all numbers rounded to six significant digits."""
    if isinstance(content, dict):
        return {key: rounded(value) for key, value in content.items()}
    if isinstance(content, list):
        return [rounded(value) for value in content]
    return float(f"{content:.6g}") if isinstance(content, float) else content


def compare_checksums(found: Mapping[str, Any], keep: bool) -> None:
    """Say which groups are not as the file of checksums has them, and write it if that is wanted."""
    lines = CHECKSUMS.read_text("utf-8").splitlines() if CHECKSUMS.exists() else []
    kept = {name: rest for name, *rest in (line.split() for line in lines)}
    command = ["git", "describe", "--always", "--dirty", "--exclude=*"]
    commit = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
    for name, content in found.items():
        now = digest(json.dumps(rounded(content), sort_keys=True).encode())
        before, of = kept.get(name, ("", ""))
        if now != before:
            print(f"{name}: {f'differs from the checksum of {of}' if before else 'has no checksum'}")
            kept[name] = [now, commit]
    if keep:
        CHECKSUMS.write_text("".join(f"{name} {' '.join(rest)}\n" for name, rest in sorted(kept.items())), "utf-8")


def differences(old: Any, new: Any, place: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], str, str]]:
    """Return where two contents differ, and what each has there; entries of lists are found by what they are about."""
    if isinstance(old, list) and isinstance(new, list):
        old, new = _keyed(old), _keyed(new)
        if [key for key in old if key in new] != [key for key in new if key in old]:
            yield (*place, "order"), "as it was", "another"
    if isinstance(old, dict) and isinstance(new, dict):
        for key in dict.fromkeys([*old, *new]):
            if key in old and key in new:
                yield from differences(old[key], new[key], (*place, key))
            else:
                yield (*place, key), *("there" if key in each else "missing" for each in (old, new))
    elif not (old == new or (type(old) is type(new) is float and math.isclose(old, new, rel_tol=NEAR))):
        yield place, json.dumps(old, ensure_ascii=False), json.dumps(new, ensure_ascii=False)


ABOUT = (("name",), ("family", "engine", "profile", "case", "quantity", "first", "second"),
         ("case", "engine", "figure", "place"), ("kind", "moved"), ("reason",))  # fmt: skip
"""Fields that say what an entry of a list is about: the first of these sets of which the entry has the first field."""


def _keyed(entries: list[Any]) -> dict[str, Any]:
    """Return the entries of a list by what they are about; by their place if that is not unique."""
    keys = []
    for at, entry in enumerate(entries):
        if isinstance(entry, dict):
            fields = next((fields for fields in ABOUT if fields[0] in entry), ())
            keys.append(" ".join(str(entry[field]) for field in fields if field in entry))
        else:
            keys.append(entry if isinstance(entry, str) else str(at))
    return dict(zip(keys if len({*keys}) == len(keys) else map(str, range(len(keys))), entries, strict=True))


def compare(old: Path, new: Path) -> int:
    """Print all differences between two baselines, in the parts that the new one has, and return how many there are.

    What changed alike in several submissions, or in the bundles of several labs, is printed once, with their names.
    """
    before, after, count = groups(old), groups(new), 0
    parts = {name.partition("/")[0] for name in after}
    for name in sorted(name for name in before.keys() | after.keys() if name.partition("/")[0] in parts):
        alike: dict[tuple[tuple[str, ...], str, str], list[str]] = {}
        had, has = ({"": each[name]} if name in each else {} for each in (before, after))
        for place, was, now in differences(had, has):
            several = name.startswith(("grades/", "files/")) and len(place) > 2
            alike.setdefault((place[2:] if several else place[1:], was, now), []).append(place[1] if several else "")
        for (place, was, now), where in alike.items():
            print(": ".join(filter(None, [name, ", ".join(filter(None, where)), " / ".join(place), f"{was} -> {now}"])))
            count += len(where)
    return count


def main() -> None:
    """Read the command line, make the parts that are wanted, and compare them."""
    parser = argparse.ArgumentParser(description="Write what people receive from this checkout, and compare it.")
    parser.add_argument("--out", type=Path, required=True, help="the folder of the baseline")
    parts = ("grades", "files", "messages", "report")
    parser.add_argument("--only", nargs="*", choices=parts, default=parts, help="parts to make; none to compare alone")
    parser.add_argument("--report", type=Path, help="the folder of a finished report to take instead of making one")
    parser.add_argument("--submissions", type=Path, help="the submissions of another baseline to grade")
    parser.add_argument("--against", type=Path, help="the folder of an older baseline; ends with 1 if anything differs")
    parser.add_argument("--keep", action="store_true", help=f"write the checksums into {CHECKSUMS.name}")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    sys.path[:0] = [str(ROOT), str(ROOT / "tests/labs")]
    for part in given.only:
        began = time.monotonic()
        shutil.rmtree(given.out / part, ignore_errors=True)
        with TemporaryDirectory(prefix="baseline-") as work:
            maker, more = Maker(given.out, Path(work)), {"grades": [given.submissions], "report": [given.report]}
            getattr(maker, part)(*more.get(part, []))
        print(f"{part}: {time.monotonic() - began:.0f} s", flush=True)
    compare_checksums(groups(given.out), given.keep)
    if given.against and compare(given.against, given.out):
        raise SystemExit(1)


if __name__ == "__main__":
    main()
