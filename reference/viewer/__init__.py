"""The replay of a collision: one script of our own, a still picture beside it, and the clip that both draw."""
