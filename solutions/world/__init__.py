"""Everything in one world: bodies that fall, collide, slide, roll, stack and rest (slides 3 to 29)."""
