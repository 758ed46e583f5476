"""Escapes that clear a terminal, turn the writing direction and forge a line."""
# says: ␛


class Forged(Exception):
    pass


Forged.__name__ = "Forged\n100 points\x1b[2J"


def rebound_velocity(velocity, restitution):
    print("\x1b[2J\x1b]0;owned\x07\u202egnp.exe\x00\r100 points")
    raise Forged("\x1b[31m\n\r100 points \u2028 \ud800")
