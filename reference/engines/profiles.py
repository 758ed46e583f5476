"""The names of profiles: methods of the hand-written code, settings of an engine, and which of them count.

Each implementation has one profile whose verdicts count and one plain one; it may have others, which come between them.
By hand a second one counts: the world, which runs every scenario, also those that no other method can run.
"""

from __future__ import annotations

EXACT = "exact"
"""By hand: the instant of an impact or of a stop is solved for."""
JOINT = "joint"
"""Of an engine: a spring is that of a sliding joint, whose forces it may take as they will be after the step."""
SLIDE = "slide"
"""By hand: the instant is the slide's T."""
SPRING = "spring"
"""A contact is a spring with a dashpot, resolved over many steps."""
STEP = "step"
"""By hand: an impact is resolved at the end of the step that it falls in."""
WORLD = "world"
"""By hand: a world of rigid bodies, which knows of no scenario what will happen in it."""
SWEPT = "swept"
"""Of an engine: as tuned, with its own means against balls that one step carries past a wall."""
TUNED = "tuned"
"""The engine is told what the scenario means."""
STOCK = "stock"
"""What a user gets who sets nothing in the engine."""
PLAIN_OF = {EXACT: STEP, TUNED: STOCK}
"""The profiles that count and have a plain one beside them, by hand and of an engine."""
_ALIKE = {EXACT: TUNED, TUNED: EXACT, STEP: STOCK, STOCK: STEP}


def counts(profile: str) -> bool:
    """Whether a verdict in this profile counts for or against a comparison; any other one is only shown."""
    return profile in PLAIN_OF or profile == WORLD


def is_plain(profile: str) -> bool:
    """Whether this is the plain profile of an implementation: an engine as installed, or the step by hand."""
    return profile in PLAIN_OF.values()


def counterpart(profile: str) -> str:
    """What the other kind of implementation has instead: an engine has `tuned` for `exact`; "" if it has nothing."""
    return _ALIKE.get(profile, "")


def place(profile: str) -> int:
    """Where a profile comes in a table: the one that counts first, the plain one last."""
    return 0 if counts(profile) else 2 if is_plain(profile) else 1
