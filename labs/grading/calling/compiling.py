"""What every process of a submission gets first: the text, and the code that the first of them made of it.

Threat: code from a process that has run the submission could carry something from one test into the next. So only one
process is asked for the code, and it sends the code before it runs any of the text. For us these are bytes: we neither
read nor run them. The processes that get them are shut in just as if they had compiled the text themselves.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from labs.grading.worker import messages


@dataclass
class Beginning:
    """The first message to each process of a submission.

    text: of the submission. printed: how many characters of what it prints are kept. code: what the text is compiled
    to, True as long as no process has been asked for it, and None if each process has to compile the text itself.
    """

    text: str
    printed: int
    code: Any = None
    _packed: bytes = b""

    @property
    def asks(self) -> bool:
        """Whether the message asks a process for the code."""
        return self.code is True

    def message(self) -> bytes:
        """The message; it is made once for all processes that get the same."""
        if not self._packed:
            text = np.frombuffer(self.text.encode(), np.uint8)  # as bytes, whose commas nobody counts
            self._packed = messages.pack((text, self.printed, self.code))
        return self._packed

    def keep(self, code: Any) -> None:
        """Keep the code that a process has sent."""
        self.code, self._packed = code if isinstance(code, np.ndarray) else None, b""
