"""Text of a student, made fit to be shown: equal files get equal words."""

from __future__ import annotations

import pytest

from labs.grading.safe_text import one_line, plain


@pytest.mark.parametrize(
    ("said", "shown"),
    [
        ("<function allclose at 0x7f54ef3d49f0>", "<function allclose>"),
        ("<Body object at 0x000001F2A9C04D60>", "<Body object>"),
        ("<bound method Body.push of <Body object at 0x10beef>>", "<bound method Body.push of <Body object>>"),
        ('<code object f at 0x7f12ab34cd56, file "lab.py", line 3>', '<code object f, file "lab.py", line 3>'),
        ("it begins at 0x10 and ends at 0x20.", "it begins at 0x10 and ends at 0x20."),
        ("0x7f54ef3d49f0", "0x7f54ef3d49f0"),
    ],
)
def test_an_address_in_memory_is_left_out(said, shown):
    assert plain(said) == one_line(said) == shown


@pytest.mark.parametrize("limit", range(10, 40))
def test_no_part_of_an_address_is_left_where_a_text_is_cut(limit):
    first, second = (one_line(f"<function f at 0x7f54ef3d{last}>, and more words", limit) for last in ("49f0", "51a8"))
    assert first == second
