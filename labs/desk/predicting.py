"""The calls about predictions: one is kept, and what answers it stays folded until it was made."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import EllipsisType

from labs.desk.predictions import Prediction
from labs.desk.predictions import predicted as made_prediction
from labs.desk.refusals import errors_in_words
from labs.grading.wrapping import folded
from labs.guidance.hint_files import hints


class Predicting:
    """The part of the desk that keeps predictions. topic: of the lab that was begun; empty if none was."""

    topic = ""

    def __init__(self) -> None:
        super().__init__()
        self._predictions: dict[str, Prediction] = {}

    @errors_in_words
    def predict(
        self,
        key: str,
        question: str,
        answer: float | str | EllipsisType | None = None,
        unit: str = "",
        choices: Sequence[str] = (),
    ) -> None:
        """Keep what you expect and compare it with the result. That you predict counts; being wrong costs nothing."""
        right = hints(self.topic).answers.get(key) if self.topic else None
        self._predictions[key] = made_prediction(key, question, answer, unit, choices, right)
        for line in str(self._predictions[key]).splitlines():
            print("\n".join(folded(line, 0)))

    @errors_in_words
    def show(
        self, experiment: Callable[[], object], *, predicted: str | Sequence[str] = (), unfold: bool = False
    ) -> None:
        """Call an experiment of the notebook, a function without arguments, and compare predictions with its result.

        predicted: the key of a prediction, or several keys; the experiment is not run until these predictions were
        made. unfold: whether to run it without them. An experiment that calls an unwritten function says so.
        """
        predictions = self._predicted(predicted, unfold)
        if predictions is None:
            return
        try:
            experiment()
        except NotImplementedError as waits:  # of a function that is still as it was handed out
            print(f"This runs as soon as you have written what it needs ({waits}).")
            return
        for each in predictions:
            print("\n".join(folded(each.verdict(), 0)))

    def _predicted(self, keys: str | Sequence[str], unfold: bool) -> list[Prediction] | None:
        """The predictions with those keys; None, with a line that says so, if one of them was not made yet."""
        keys = [key for key in ([keys] if isinstance(keys, str) else keys) if key]
        made = {key: each for key, each in self._predictions.items() if each.answer is not None}
        if (open_keys := [key for key in keys if key not in made]) and not unfold:
            print(
                f"Folded until you have predicted {', '.join(map(repr, open_keys))} in a cell above (or: unfold=True)."
            )
            return None
        return [made[key] for key in keys if key in made]
