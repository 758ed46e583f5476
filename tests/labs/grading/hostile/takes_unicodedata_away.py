"""The module that compiling needs for a Greek letter, replaced by one that lies."""
# says: gave 0.0|raised

import sys


class Liar:
    def __getattr__(self, name):
        return lambda *_: "expected"


sys.modules["unicodedata"] = Liar()


def rebound_velocity(velocity, restitution):
    found = {}
    exec("ε = 0.0\n𝐚 = 1.0", found)
    return found["ε"]
