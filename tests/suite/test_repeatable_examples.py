"""What a property is tried with depends on the property alone."""

from __future__ import annotations

import sys
from types import ModuleType

from hypothesis import given, settings
from hypothesis import strategies as st


def drawn() -> list[float]:
    """All examples of one property."""
    numbers = []

    @settings(max_examples=300)
    @given(st.floats(1e5, 2e5))
    def collect(number: float) -> None:
        numbers.append(number)

    collect()
    return numbers


def test_a_constant_in_an_imported_module_changes_no_example(tmp_path, monkeypatch):
    before = drawn()
    module = ModuleType("imported")
    module.__file__ = str(tmp_path / "imported.py")
    (tmp_path / "imported.py").write_text("NUMBER = 123456.789\n")
    monkeypatch.setitem(sys.modules, "imported", module)
    assert drawn() == before
