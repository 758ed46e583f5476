"""Answers of odd types and odd bits cost points in their own function, and never the grade of the whole submission."""

from __future__ import annotations

import pytest
from submissions import stubs

from labs.grading.judging.pytest_run import run

ODD = {
    "signalling NaN of single precision": 'np.frombuffer(b"\\x01\\0\\x80\\x7f" * 3, "<f4")',
    "signalling NaN of half precision": 'np.frombuffer(b"\\x01\\x7c" * 3, "<f2")',
    "signalling NaN of the other byte order": 'np.frombuffer(b"\\x7f\\xf0\\0\\0\\0\\0\\0\\x01" * 3, ">f8")',
    "signalling NaN in a complex number": 'np.frombuffer(b"\\x01\\0\\0\\0\\0\\0\\xf0\\x7f" * 2, "<c16")',
    "signalling NaN of Python": '__import__("struct").unpack("<d", b"\\x01\\0\\0\\0\\0\\0\\xf4\\x7f")[0]',
    "wide bits without a meaning": 'np.frombuffer(b"\\x01" * 48, np.longdouble)',
    "a wide number beyond all others": "np.full(3, np.longdouble(10) ** 4000)",
    "the largest numbers": "np.array([1e308, -1e308, 1e308])",
    "the smallest numbers": "np.full(3, 5e-324)",
    "whole numbers beyond 64 bits": "[10**400, 1, 2]",
    "unsigned numbers": "np.full(3, 2**64 - 1, dtype=np.uint64)",
    "objects": 'np.array([1, "a", None], dtype=object)',
    "a masked array": "np.ma.array([1.0, 2, 3], mask=[0, 1, 0])",
    "texts": 'np.array(["1", "2", "3"])',
    "dates": 'np.array(["2020-01-01"], dtype="M8[D]")',
    "fields": 'np.zeros(3, dtype=[("x", "f8")])',
    "a million numbers": "np.zeros(10**6)",
    "one number a milliard times": "np.broadcast_to(np.float64(1), (10**9,))",
    "rows without numbers": "np.zeros((10**7, 0))",
    "a view that runs backwards": "np.arange(3.0)[::-1]",
    "numbers deep inside": "[[[[[1.0]]]]]",
    "rows of different lengths": "[[1, 2], [3]]",
    "a signalling decimal": '__import__("decimal").Decimal("sNaN")',
    "a fraction": '__import__("fractions").Fraction(1, 3)',
}
SEVERAL = {"apply_impulse": 4, "collide": 4, "audit": 3}
FUNCTIONS = (
    "normal_velocity", "edge_edge_normal", "world_inverse_inertia", "inverse_effective_mass", "impulse_magnitude",
    "apply_impulse", "collide", "audit",
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.usefixtures("one_grader")
@pytest.mark.parametrize("start", range(0, len(ODD), len(FUNCTIONS)))
def test_odd_answers_earn_nothing_and_end_no_grading(start, tmp_path):
    path = stubs(tmp_path, "impulse")
    answers = [*ODD.values()][start : start + len(FUNCTIONS)]
    for name, answer in zip(FUNCTIONS, answers, strict=True):
        count = SEVERAL.get(name, 1)
        whole = f"({f'{answer}, ' * count})" if count > 1 else answer
        with path.open("a", encoding="utf-8") as file:
            file.write(f"\n\ndef {name}(*given):\n    return {whole}\n")
    sheet = run(path, ("impulse",))
    assert sheet.earned == 0
    assert {each.function for each in sheet.outcomes} == {*FUNCTIONS}
    assert all(sheet.diagnosis(name) for name in FUNCTIONS)
