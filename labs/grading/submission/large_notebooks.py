"""A notebook whose pictures and tables make it too large to be read, without them.

Threat: the file is hostile data, and JSON as Python objects takes thirty times the memory of its text. So the text is
walked through by a regular expression that never goes back, and stopped after a number of steps. It becomes no object.
"""

from __future__ import annotations

import re

LARGEST = 64 * 2**20
"""Bytes of the largest notebook that is walked through."""
_MOST_STEPS = 4_000_000
"""Some three seconds. A step is a text, a bracket, or a whole list without others in it."""
_LEFT_OUT = (b'"outputs"', b'"attachments"', b'"widgets"')
"""Keys of the notebook format whose content is no code and may be large."""
_TEXT = rb'"(?:[^"\\]++|\\.)*+(?:"|\\?\Z)'
_STEP = re.compile(rb'[\[{](?:[^"\[\]{}]++|' + _TEXT + rb")*+[\]}]|" + _TEXT + rb"|[\[\]{}]", re.DOTALL)


def without_outputs(raw: bytes) -> bytes | None:
    """The notebook with its outputs, attachments and widgets empty; None if that would take too many steps."""
    kept, start = list[bytes](), 0
    depth, left_out_at, after_key = 0, 0, 0
    for count, step in enumerate(_STEP.finditer(raw)):
        if count > _MOST_STEPS:
            return None
        first, end = raw[step.start()], step.end()
        opens, closes = first in b"[{", first in b"]}"
        if opens and raw[end - 1] not in b"]}":
            depth += 1
            if after_key and not left_out_at and raw[after_key : step.start()].strip() == b":":
                kept.append(raw[start:end])
                left_out_at = depth
        elif closes:
            if left_out_at == depth:
                start, left_out_at = step.start(), 0
            depth -= 1
        is_key = not opens and not closes and end - step.start() <= 16 and step.group() in _LEFT_OUT
        after_key = end if is_key else 0
    return None if left_out_at else b"".join([*kept, raw[start:]])
