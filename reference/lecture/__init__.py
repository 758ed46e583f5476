"""What the lab teaches: the lecture "Collisions" by Rick Parent, CIS 682.

This package is the single truth for the order of the topics, for the thirty statements of the slides and for the
functions that belong to them. Notebooks, checks, report and documentation read it and repeat none of it.

Conventions, here and in the whole lab: SI units, right-handed axes, z up. The contact normal `n` is a unit vector from
B to A. The relative velocity is u = ṗ_A − ṗ_B, and u_n = n·u is negative when approaching. An impulse acts as j n on A
and as −j n on B. Quaternions are w, x, y, z. A separation is signed, negative when overlapping.
"""

from reference.lecture.functions import FUNCTIONS, Function, Role, function, functions_of
from reference.lecture.statements import STATEMENTS, Statement, statement
from reference.lecture.topics import TOPICS, Topic, topic

__all__ = [
    "FUNCTIONS",
    "STATEMENTS",
    "TOPICS",
    "Function",
    "Role",
    "Statement",
    "Topic",
    "function",
    "functions_of",
    "statement",
    "topic",
]
