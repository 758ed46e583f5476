"""What a piece of code is made of: any change that may change a result is seen, and nothing else is."""

from __future__ import annotations

from pathlib import Path

import pytest

from reference.running import sources
from reference.running.sources import digest


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    """A folder that Python imports from: a file, a module and a package that it imports, and one that it does not."""
    monkeypatch.syspath_prepend(str(tmp_path))
    for name, text in {
        "mine.py": "import numpy\nimport helper_of_mine\ndef f():\n    from kit_of_mine.part import g\n    return g\n",
        "helper_of_mine.py": "import helper_of_helper\nX = 1\n",
        "helper_of_helper.py": "import mine\n",  # in a circle
        "kit_of_mine/__init__.py": "",
        "kit_of_mine/part.py": "def g(): return 1\n",
        "kit_of_mine/deep/other.py": "Y = 2\n",
        "stranger.py": "Z = 3\n",
    }.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    "name",
    ["mine.py", "helper_of_mine.py", "helper_of_helper.py", "kit_of_mine/part.py", "kit_of_mine/deep/other.py"],
)
def test_a_change_of_anything_that_a_file_imports_is_seen(name, folder):
    before = digest(str(folder / "mine.py"))
    with (folder / name).open("a", encoding="utf-8") as file:
        file.write("# a change\n")
    assert digest(str(folder / "mine.py")) != before


@pytest.mark.parametrize("name", ["helper_of_mine.py", "helper_of_helper.py", "kit_of_mine/part.py"])
def test_what_lies_beside_a_file_is_seen_though_python_does_not_look_there_yet(name, folder, monkeypatch):
    """The file may say `sys.path.insert(0, …)` as it runs."""
    monkeypatch.undo()
    before, in_a_worker = digest(str(folder / "mine.py")), sources.Texts(files_again=True)
    assert digest(str(folder / "mine.py"), in_a_worker) == before
    with (folder / name).open("a", encoding="utf-8") as file:
        file.write("# a change\n")
    assert digest(str(folder / "mine.py")) != before
    assert digest(str(folder / "mine.py"), in_a_worker) == before  # which has imported it, and imports it only once


@pytest.mark.parametrize(
    "text",
    [
        "import {}",
        "import\t{}.part",
        "import numpy, {} as shorter, json",
        "from {}.part import g",
        "def f():\n\tfrom {}.part import (\n\t\tg,\n\t)",
        "import {}\r\nimport json\r\n",
        "import {}  # a word about it",
        "X = 1; import {}",
        "if True: import {}",
        "from json import load; import {}",
        "from {} \\\n    import part",
        "from {} \\\r\n    import part",
        "import json, \\\n    {}",
        "import \\\n    {}",
    ],
)
def test_an_import_is_found_however_it_is_written(text, folder):
    (folder / "mine.py").write_bytes(text.format("kit_of_mine").encode())
    compile((folder / "mine.py").read_bytes(), "mine.py", "exec")
    before = digest(str(folder / "mine.py"))
    (folder / "kit_of_mine" / "part.py").write_text("def g(): return 2\n", encoding="utf-8")
    assert digest(str(folder / "mine.py")) != before


@pytest.mark.parametrize(
    "text", ["from .kit_of_mine import g", "X = 'import kit_of_mine'", "import json  # kit_of_mine"]
)
def test_what_only_looks_like_an_import_is_not_seen(text, folder):
    (folder / "mine.py").write_text(text, encoding="utf-8")
    before = digest(str(folder / "mine.py"))
    (folder / "kit_of_mine" / "part.py").write_text("def g(): return 2\n", encoding="utf-8")
    assert digest(str(folder / "mine.py")) == before


def test_a_new_file_in_a_package_is_seen(folder):
    before = digest("kit_of_mine")
    (folder / "kit_of_mine" / "more.py").write_text("", encoding="utf-8")
    assert digest("kit_of_mine") != before


@pytest.mark.parametrize(("old", "new"), [("part.py", "piece.py"), ("deep", "deeper")])
def test_a_renamed_or_moved_file_is_another_package(old, new, folder):
    before = digest("kit_of_mine")
    (folder / "kit_of_mine" / old).rename(folder / "kit_of_mine" / new)
    assert digest("kit_of_mine") != before


def test_what_is_not_imported_is_not_seen(folder):
    before = digest(str(folder / "mine.py"))
    (folder / "stranger.py").write_text("Z = 4\n", encoding="utf-8")
    assert digest(str(folder / "mine.py")) == before


def test_nothing_is_imported_or_run(folder):
    (folder / "mine.py").write_text("raise SystemExit('it ran')\n", encoding="utf-8")
    assert len(digest(str(folder / "mine.py"))) == 64


def test_a_text_that_is_not_python_has_a_hash_too(folder):
    path = folder / "mine.py"
    path.write_text("def (:\n", encoding="utf-8")
    before = digest(str(path))
    path.write_text("def ):\n", encoding="utf-8")
    assert digest(str(path)) != before


def test_imported_packages_are_read_once_and_files_always(folder):
    texts = sources.Texts(files_again=True)
    package, file = digest("kit_of_mine", texts), digest(str(folder / "mine.py"), texts)
    for name in ("kit_of_mine/part.py", "mine.py"):
        with (folder / name).open("a", encoding="utf-8") as text:
            text.write("# a change\n")
    assert digest("kit_of_mine", texts) == package
    assert digest("kit_of_mine") != package
    assert digest(str(folder / "mine.py"), texts) != file


def test_the_digest_covers_the_lab_and_not_installed_packages():
    assert sources._is_own("solutions")
    assert sources._is_own("reference")
    assert not sources._is_own("numpy")
    assert not sources._is_own("json")
    assert not sources._is_own("no_such_module_anywhere")


def test_a_missing_file_is_an_error_of_the_system(tmp_path):
    with pytest.raises(FileNotFoundError):
        digest(str(tmp_path / "none.py"))


def test_an_installed_lab_is_seen_and_what_is_installed_beside_it_is_not(tmp_path, monkeypatch):
    folder = tmp_path / "site-packages"
    monkeypatch.setattr(sources, "_HERE", folder)
    monkeypatch.setattr(sources, "_places", lambda name: [folder / name])
    assert sources._is_own("solutions")
    assert not sources._is_own("rich")
