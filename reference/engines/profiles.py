"""The two profiles that every engine has. An engine may have others, which come between these two."""

from __future__ import annotations

TUNED = "tuned"
"""The engine is told what the scenario means."""
STOCK = "stock"
"""What a user gets who sets nothing."""
