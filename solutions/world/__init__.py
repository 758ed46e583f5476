"""Everything in one world: bodies fall, collide, slide, roll, stack and rest."""
