"""How much each kind of work counts in the mark of a lab."""

from __future__ import annotations

CODE, QUESTIONS, INPUTS, PREDICTIONS = "functions", "written questions", "inputs found", "predictions made"
SHARES = {CODE: 45, QUESTIONS: 35, INPUTS: 15, PREDICTIONS: 5}
"""Points of a hundred. Functions alone are less than half of the mark: an answer in one's own words, and an input that
shows what is wrong with somebody else's function, say more about what was understood."""
