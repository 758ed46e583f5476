"""A notebook that is large for its outputs alone is read without them, within a budget."""

from __future__ import annotations

import json
import time

import pytest
from submissions import BOTH, WANTED, handed_in, told

from labs.grading.errors import UnreadableSubmission
from labs.grading.submission.large_notebooks import LARGEST, without_outputs
from labs.grading.submission.opening import FILE_LIMIT

MORE = FILE_LIMIT + 2**20


def code(source: str, **others: object) -> dict[str, object]:
    return {"cell_type": "code", "source": source, "metadata": {"tags": ["outputs"]}, **others}


PICTURE = {"output_type": "display_data", "data": {"image/png": "iVBOR" * (MORE // 5)}}
TABLE = {"output_type": "display_data", "data": {"application/json": [{"x": [[1.5] * 20, []]}] * (MORE // 100)}}
STREAM = {"output_type": "stream", "text": ['step "1" of [2]\\ {\n'] * (MORE // 22)}
PASTED = {"cell_type": "markdown", "source": "![](attachment:a)", "attachments": {"a": {"image/png": "A" * MORE}}}


@pytest.mark.parametrize(
    "cells",
    [
        [code(BOTH, outputs=[PICTURE])],
        pytest.param(
            [code(BOTH, outputs=[TABLE, {"outputs": [3]}]), code("x = 1", outputs=[])], marks=pytest.mark.slow
        ),
        pytest.param(
            [code("x = '\"outputs\": ['", outputs=[STREAM]), code(BOTH, outputs=[STREAM])], marks=pytest.mark.slow
        ),
        [PASTED, code(BOTH, outputs="none")],
    ],
    ids=["a picture", "a deep table", "many lines", "a pasted picture"],
)
@pytest.mark.parametrize("indent", [None, pytest.param(1, marks=pytest.mark.slow)])
def test_a_notebook_with_large_outputs_is_read_without_them(tmp_path, cells, indent):
    content = json.dumps({"cells": cells, "metadata": {"widgets": {"state": {"a": [1]}}}}, indent=indent).encode()
    submission = handed_in(tmp_path, content)
    assert submission.functions == WANTED
    assert told(submission) == f"it has {len(content) / 2**20:.0f} MB, and its outputs are not read: clear them"


def test_only_outputs_are_left_out():
    cells = [code("outputs = {'outputs': [1]}", outputs=[{"a": ["]", "}"]}]), code("y", outputs=[])]
    book = {"cells": cells, "metadata": {"widgets": {"s": {}}, "outputs": "kept"}, "nbformat": 4}
    smaller = without_outputs(json.dumps(book).encode())
    wanted = {**book, "cells": [{**cells[0], "outputs": []}, cells[1]], "metadata": {"widgets": {}, "outputs": "kept"}}
    assert json.loads(smaller or b"") == wanted


@pytest.mark.slow
@pytest.mark.parametrize("unit", [b"[", b'"",', b'{"outputs":[', b'"\\', b"{[}", b"0,"], ids=lambda unit: unit.decode())
def test_a_large_file_that_no_program_writes_is_refused_within_the_budget(tmp_path, unit):
    content = b'{"outputs":[' + unit * ((LARGEST - 20) // len(unit))
    began = time.process_time()
    with pytest.raises(UnreadableSubmission, match="MB, and at most 10 are read besides outputs, and 64 with them"):
        handed_in(tmp_path, content)
    assert time.process_time() - began < 20.0  # four on the slowest machine seen
