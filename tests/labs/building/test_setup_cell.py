"""The first cell of a notebook finds the lab wherever the notebook stands, and on Colab fetches it."""

from __future__ import annotations

import io
import sys
import tomllib
import zipfile
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

from labs import notebook
from labs.building import notebooks
from labs.project_folders import ROOT

ASKED = "Choose the archive that you were given"


@pytest.fixture(scope="module")
def setup_cell() -> str:
    """The first cell of a notebook, as a kernel reads it."""
    from IPython.core.inputtransformer2 import TransformerManager  # noqa: PLC0415 - not where other tests are collected

    first = next(cell for cell in notebooks.student("detection")["cells"] if cell["cell_type"] == "code")
    return TransformerManager().transform_cell("".join(first["source"]))


@pytest.fixture
def run(setup_cell, monkeypatch, tmp_path):
    """Runs the cell in a folder, and returns the first place where modules are then looked for."""
    began, commands = [], []
    monkeypatch.setattr(notebook.Lab, "begin", lambda self, topic: began.append(topic))
    monkeypatch.setattr(sys, "path", ["first"])

    def cell(folder: Path) -> str:
        monkeypatch.chdir(folder)
        began.clear()
        exec(setup_cell, {"get_ipython": lambda: SimpleNamespace(system=commands.append)})
        assert began == ["detection"]
        return sys.path[0]

    cell.commands = commands
    return cell


@pytest.fixture
def colab(monkeypatch):
    """A machine of Colab's: `google.colab` is loaded. What a person uploads, by name, is put into what comes back."""
    chosen: dict[str, bytes] = {}
    google, inside, files = (ModuleType(name) for name in ("google", "google.colab", "google.colab.files"))

    def upload() -> dict[str, bytes]:
        """As Colab does: the file goes beside one of the same name, and the answer keeps the name that it had."""
        for name, content in chosen.items():
            Path(f"{Path(name).stem} (1).zip" if Path(name).exists() else name).write_bytes(content)
        return dict(chosen)

    files.upload = upload
    inside.files, google.colab = files, inside
    for module in (google, inside, files):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    return chosen


def tree(folder: Path) -> Path:
    """What makes a folder the lab's."""
    (folder / "labs" / "notebooks").mkdir(parents=True)
    (folder / "labs" / "notebook.py").touch()
    return folder


def archive(top: str = "collisions-lab", file: str = "labs/notebook.py") -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as packed:
        packed.writestr(f"{top}/{file}", "")
    return content.getvalue()


@pytest.mark.parametrize("inside", ["labs/notebooks", "labs", ".", "mine/week 3"])
def test_the_lab_is_found_from_any_folder_of_the_release(inside, run, tmp_path):
    course = tree(tmp_path / "my course, 2. term")
    folder = course / inside
    folder.mkdir(parents=True, exist_ok=True)
    assert run(folder) == str(course)


def test_the_lab_is_found_in_a_folder_beside_the_notebook(run, tmp_path):
    course = tree(tmp_path / "collisions-lab")
    assert run(tmp_path) == str(course)


def test_an_installed_lab_needs_no_folder(run, tmp_path):
    assert run(tmp_path) == "first"
    assert run.commands == []


def test_outside_colab_nothing_is_requested_or_installed(run, tmp_path, capsys):
    run(tree(tmp_path))
    assert ASKED not in capsys.readouterr().out
    assert run.commands == []


@pytest.mark.parametrize("name", ["collisions-lab.zip", "detection (1).zip", "lab.ZIP"])
def test_on_colab_the_archive_is_requested_under_any_name(name, run, colab, tmp_path, capsys):
    colab[name] = archive()
    assert run(tmp_path) == str(tmp_path / "collisions-lab")
    assert ASKED in capsys.readouterr().out
    needed, bullet, dart = run.commands  # what has no package must not stop the others
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["optional-dependencies"]
    assert f'"{extras["mujoco"][0]}"' in needed
    assert dart == f'pip install --quiet "{extras["dart"][0]}"'
    assert bullet == 'pip install --quiet --no-deps --require-hashes -r "{bullet}"'  # IPython puts the path there


def test_on_colab_the_archive_may_hold_a_folder_of_any_name(run, colab, tmp_path):
    colab["detection.zip"] = archive("week 3")
    assert run(tmp_path) == str(tmp_path / "week 3")


def test_notebooks_of_earlier_labs_are_requested_only_where_runs_take_functions_from_them():
    first = {topic: "".join(notebooks.student(topic)["cells"][2]["source"]) for topic in ("detection", "impulse")}
    assert "With it you may choose" not in first["detection"]
    assert "With it you may choose detection.ipynb," in first["impulse"]


def test_on_colab_the_archive_is_requested_once(run, colab, tmp_path, capsys):
    colab["collisions-lab.zip"] = archive()
    run(tmp_path)
    capsys.readouterr()
    colab.clear()
    assert run(tmp_path) == str(tmp_path / "collisions-lab")  # as after a restart, which leaves the files
    assert ASKED not in capsys.readouterr().out


@pytest.mark.parametrize(
    "wrong", [{}, {"essay.pdf": b"%PDF"}, {"lab.zip": b"half of an arch"}, {"sea.zip": archive(file="beach.jpg")}]
)
def test_on_colab_a_wrong_file_is_refused_and_requested_again(wrong, run, colab, tmp_path):
    colab.update(wrong)
    with pytest.raises(FileNotFoundError, match="no archive of the lab: run this cell again"):
        run(tmp_path)
    colab.clear()
    colab["collisions-lab.zip"] = archive()
    assert run(tmp_path) == str(tmp_path / "collisions-lab")
