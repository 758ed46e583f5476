"""The two profiles that every engine has; an engine may have more between them."""

from __future__ import annotations

TUNED = "tuned"
"""The engine is told what the scenario means."""
STOCK = "stock"
"""What a user gets who sets nothing."""
