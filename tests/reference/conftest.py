"""What the tests of the grid share."""

from __future__ import annotations

import pytest

pytest.register_assert_rewrite("promises")  # so that a broken promise shows its numbers
