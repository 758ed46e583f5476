"""A run with a list of skips fails at a skip for any other reason."""

from __future__ import annotations

import pytest

SKIPPED = {"test_skips.py": "import pytest\ndef test_skips(): pytest.skip('no igl 2.6 here')\n"}


@pytest.mark.parametrize(("listed", "code"), [("no scipy here", 1), ("# igl\nno igl * here", 0)])
def test_a_skip_for_a_reason_that_is_not_listed_fails_the_run(run_pytest, tmp_path, listed, code):
    (tmp_path / "list.txt").write_text(listed, encoding="utf-8")
    ended = run_pytest(SKIPPED, "-n", "0", f"--skips={tmp_path / 'list.txt'}")
    assert ended.returncode == code
    assert ("not in the list of skips: no igl 2.6 here, in test_skips.py::test_skips" in ended.stdout) == bool(code)


def test_a_file_that_is_skipped_as_a_whole_is_seen_as_well(run_pytest, tmp_path):
    (tmp_path / "list.txt").write_text("", encoding="utf-8")
    files = {"test_whole.py": "import pytest\npytest.importorskip('no_such_package')\n"}
    assert run_pytest(files, "-n", "0", f"--skips={tmp_path / 'list.txt'}").returncode == 1
