"""Tables that a file fills at its top level are filled, however that is written; what only shows them is left out."""

from __future__ import annotations

import pytest
from submissions import defined, handed_in, sheet_of

from labs.grading.calling.remote import Grader
from labs.grading.feedback import report

USED = "\ndef rebound_velocity(v, e):\n    return TABLE[1] * e * v\n"
FILLED = {
    "a loop": "TABLE = {}\nfor n in range(3):\n    TABLE[n] = -n",
    "a loop over two sequences": "TABLE = {}\nfor n, s in zip((0, 1), (0, -1)):\n    TABLE[n] = s",
    "a loop in a loop": "TABLE = [0, 0]\nfor n in range(2):\n    for m in range(2):\n        TABLE[n] -= n * m",
    "a while loop": "TABLE, n = [], 0\nwhile len(TABLE) < 3:\n    TABLE.append(-n)\n    n += 1",
    "a loop with else": "TABLE = [0]\nfor n in []:\n    pass\nelse:\n    TABLE.append(-1)",
    "a branch": "TABLE = {}\nif 1 < 2:\n    TABLE[1] = -1\nelse:\n    TABLE[1] = 5",
    "a try": "TABLE = {}\ntry:\n    TABLE[1] = {}[1]\nexcept KeyError:\n    TABLE[1] = -1",
    "a finally": "TABLE = {}\ntry:\n    pass\nfinally:\n    TABLE[1] = -1",
    "a with": "import contextlib\nTABLE = {}\nwith contextlib.suppress(KeyError):\n    TABLE[1] = -1",
    "a match": "TABLE = {}\nmatch 3:\n    case 3:\n        TABLE[1] = -1",
    "a swap": "TABLE = [-1, 0]\nTABLE[0], TABLE[1] = TABLE[1], TABLE[0]",
    "a chain": "TABLE = [0, 0]\nx = TABLE[1] = -1",
    "a star": "TABLE = [0, 0]\n*_, TABLE[1] = 3, 4, -1",
    "a slice": "TABLE = [0, 0]\nTABLE[:] = [5, -1]",
    "a loop whose target it is": "TABLE = [0, 0]\nfor TABLE[1] in (3, -1):\n    pass",
    "a target in brackets": "TABLE = [0, 0]\n[x, (y, TABLE[1])] = 1, (2, -1)",
    "a list for its effect": "TABLE = []\n[TABLE.append(-n) for n in range(2)]",
    "a list for its effect with a name": "TABLE = []\n_ = [TABLE.append(-n) for n in range(2)]",
    "a list with a kept name": "TABLE = []\nnothing = [TABLE.append(-n) for n in range(2)]",
    "any": "TABLE = []\nany(TABLE.append(-n) for n in range(2))",
    "a map": "TABLE = []\nlist(map(TABLE.append, (0, -1)))",
    "a map of a lambda": "TABLE = [0, 0]\nlist(map(lambda n: TABLE.__setitem__(n, -n), range(2)))",
    "deletion": "TABLE = {0: 1, 1: 5, 2: -1}\ndel TABLE[1]\nTABLE = dict(enumerate(TABLE.values()))",
    "deletion in a loop": "TABLE = [0, 7, 7, -1]\nfor _ in range(2):\n    del TABLE[1]",
    "pop": "TABLE = [0, 7, -1]\ngone = TABLE.pop(1)",
    "an alias": "TABLE = [0, 0]\nalias = TABLE\nalias[1] = -1",
    "an alias of an alias": "TABLE = {'rows': [0, 0]}\nrows = TABLE['rows']\nsame = rows\nsame[1] = -1\nTABLE = rows",
    "a view": "import numpy as np\nTABLE = np.zeros(4)\nodd = TABLE.reshape(2, 2)[:, 1]\nodd[:] = -1",
    "a view by a function": "import numpy as np\nTABLE = np.zeros(2)\nflat = np.ravel(TABLE)\nflat += -1",
    "rows of a loop": "import numpy as np\nROWS = np.zeros((2, 2))\nfor row in ROWS:\n    row[1] = -1\nTABLE = ROWS[0]",
    "rows of zip": "GRID = [[0, 0], [0, 0]]\nfor n, row in enumerate(GRID):\n    row[1] = -n\nTABLE = GRID[1]",
    "a bound method": "TABLE = [0]\nnote = TABLE.append\nnote(-1)",
    "a walrus": "TABLE = [0, 0]\nif (t := TABLE):\n    t[1] = -1",
    "a helper": "TABLE = {}\ndef fill(table):\n    table[1] = -1\nfill(TABLE)",
    "a helper by keyword": "TABLE = {}\ndef fill(n, *, into):\n    into[n] = -n\nfill(1, into=TABLE)",
    "a helper of helpers": "TABLE = {}\ndef put(t, n):\n    t[n] = -n\ndef fill(table):\n    for n in range(2):\n"
    "        put(table, n)\nfill(TABLE)",
    "a helper with an alias": "TABLE = {'a': [0, 0]}\ndef fill(table):\n    rows = table['a']\n    rows[1] = -1\n"
    "fill(TABLE)\nTABLE = TABLE['a']",
    "a helper in a loop": "TABLE = [0, 0]\ndef put(n):\n    TABLE[n] = -n\nfor n in range(2):\n    put(n)",
    "a helper by map": "TABLE = [0, 0]\ndef put(n):\n    TABLE[n] = -n\nlist(map(put, range(2)))",
    "a helper for each": "TABLE, OTHER = [0, 0], [0, 0]\ndef fill(t):\n    t[1] = -1\nlist(map(fill, [TABLE, OTHER]))",
    "a helper with a star": "TABLE = {}\ndef fill(*tables):\n    for t in tables:\n        t[1] = -1\nfill({}, TABLE)",
    "a lambda": "TABLE = {}\nfill = lambda t: t.update({1: -1})\nfill(TABLE)",
    "a method": "class Table:\n    def __init__(self):\n        self.rows = [0]\n    def add(self, n):\n"
    "        self.rows.append(n)\ntable = Table()\nfor n in (-1, -2):\n    table.add(n)\nTABLE = table.rows",
    "a method whose value is used": "class T(list):\n    def add(self, n):\n        self.append(n)\n        return n\n"
    "TABLE = T([0])\nlast = TABLE.add(-1)",
    "a class that notes": "TABLE = [0]\nclass Row:\n    def __init__(self, n):\n        TABLE.append(n)\n"
    "for n in (-1,):\n    Row(n)",
    "bisect": "import bisect\nTABLE = [-2, 0]\nbisect.insort(TABLE, -1)",
    "bisect by name": "from bisect import insort\nTABLE = [-2, 0]\nfor n in (-1,):\n    insort(TABLE, n)",
    "a heap": "import heapq\nTABLE = [0, -1]\nheapq.heapify(TABLE)\nTABLE = TABLE[::-1]",
    "fill_diagonal": "import numpy as np\nTABLE = np.zeros((2, 2))\nnp.fill_diagonal(TABLE, -1)\nTABLE = TABLE[1]",
    "put": "import numpy as np\nTABLE = np.zeros(2)\nnp.put(TABLE, [1], [-1])",
    "copyto": "import numpy\nTABLE = numpy.zeros(2)\nnumpy.copyto(TABLE, -1)",
    "add.at": "import numpy as np\nTABLE = np.zeros(2)\nnp.add.at(TABLE, [1], -1)",
    "out": "import numpy as np\nTABLE = np.ones(2)\nnegative = np.negative(TABLE, out=TABLE)",
    "a generator of numbers": "import numpy as np\nrng = np.random.default_rng(1)\nTABLE = np.array([-1, -1, -1])\n"
    "rng.shuffle(TABLE)",
    "fill": "import numpy as np\nTABLE = np.zeros(2)\nTABLE.fill(-1)",
    "flat": "import numpy as np\nTABLE = np.zeros((2, 1))\nTABLE.flat = [0, -1]\nTABLE = TABLE[:, 0]",
    "augmented by an alias": "import numpy as np\nTABLE = np.zeros(2)\nalias = TABLE\nalias -= 1",
    "setdefault": "TABLE = {}\nfor n in range(2):\n    TABLE.setdefault(n, -n)",
    "update": "TABLE = {}\nTABLE.update((n, -n) for n in range(2))",
    "a union": "TABLE = {}\nTABLE |= {1: -1}",
    "operator": "import operator\nTABLE = [0, 0]\noperator.setitem(TABLE, 1, -1)",
    "the type's own method": "TABLE = {}\ndict.update(TABLE, {1: -1})",
    "globals": "for name in ['TABLE']:\n    globals()[name] = [0, -1]",
    "exec": "exec('TABLE = [0, -1]')",
    "setattr": "class Rows: pass\nfor n in range(2):\n    setattr(Rows, 'row', [0, -n])\nTABLE = Rows.row",
    "a notebook's own name": "TABLE = {}\ndef main():\n    TABLE[1] = -1\nif __name__ == '__main__':\n    main()",
    "a closure": "TABLE = {}\ndef make(t):\n    def put(n):\n        t[n] = -n\n    return put\nput = make(TABLE)\n"
    "put(1)",
    "two closures": "def make():\n    t = {}\n    def put(n):\n        t[n] = -n\n    return put, t\n"
    "put, TABLE = make()\nput(1)",
    "a builder": "TABLE = {}\nclass Builder:\n    def __init__(self, t):\n        self.t = t\n    def put(self, n):\n"
    "        self.t[n] = -n\nb = Builder(TABLE)\nfor n in range(2):\n    b.put(n)",
    "a class that is derived": "TABLE = {}\nclass A:\n    def __init__(self, t):\n        t[1] = -1\nclass B(A):\n"
    "    pass\nmade = B(TABLE)",
    "a value of bisect": "import bisect\nTABLE = [-2, 0]\nnothing = bisect.insort(TABLE, -1)",
    "a value that is shown": "import bisect\nTABLE = [-2, 0]\nprint(bisect.insort(TABLE, -1))",
    "a loop in a class": "TABLE = {}\nclass K:\n    for n in range(2):\n        TABLE[n] = -n",
    "a name in a class": "TABLE = {}\nclass K:\n    t = TABLE\nK.t.update({1: -1})",
    "a function that gives it": "TABLE = {}\ndef get():\n    return TABLE\nget().update({1: -1})",
    "a lambda that gives it": "TABLE = {}\nget = lambda: TABLE\nt = get()\nt[1] = -1",
    "an end of a with": "TABLE = {}\nclass Filling:\n    def __init__(self, t):\n        self.t = t\n"
    "    def __enter__(self):\n        return self\n    def __exit__(self, *why):\n        self.t[1] = -1\n"
    "with Filling(TABLE):\n    pass",
    "an operator": "class T(dict):\n    def __lshift__(self, n):\n        self[n] = -n\nTABLE = T()\nTABLE << 1",
    "a sign": "class T(dict):\n    def __neg__(self):\n        self[1] = -1\nTABLE = T()\n-TABLE",
    "brackets": "class T(dict):\n    def __getitem__(self, n):\n        if n < 0: self[-n] = n\n"
    "        return self.get(n)\nTABLE = T()\nTABLE[-1]",
    "a generator that is sent": "TABLE = {}\ndef sink(t):\n    while True:\n        n = yield\n        t[n] = -n\n"
    "g = sink(TABLE)\nnext(g)\ng.send(1)",
    "a generator that is used up": "TABLE = {}\ndef fill(t):\n    t[1] = -1\n    yield\ng = fill(TABLE)\nlist(g)",
    "a map that is used up": "TABLE = {}\nm = map(TABLE.__setitem__, [1], [-1])\nlist(m)",
    "a text": "TABLE, PAIRS = {}, [(1, -1)]\nexec('for n, s in PAIRS: TABLE[n] = s')",
    "a metaclass": "R = {}\nclass M(type):\n    def __new__(m, n, b, d):\n        c = super().__new__(m, n, b, d)\n"
    "        R[n] = c\n        return c\nclass C(metaclass=M):\n    table = [0, -1]\nTABLE = R['C'].table",
    "the names of the file": "for name in ['TABLE']:\n    vars()[name] = [0, -1]",
    "a table in a table": "TABLE, ALL = [0, 0], {}\nALL['t'] = TABLE\nALL['t'][1] = -1",
    "a row in a list": "TABLE, ALL = [0, 0], []\nALL.append(TABLE)\nfor t in ALL:\n    t[1] = -1",
    "a method by its name": "TABLE = [0]\ngetattr(TABLE, 'append')(-1)",
    "a table of helpers": "TABLE = {}\ndef put(n):\n    TABLE[n] = -n\nDO = {'put': put}\nDO['put'](1)",
    "a class that notes in itself": "class T:\n    rows = [0]\n    def __init__(self, n):\n        T.rows.append(n)\n"
    "T(-1)\nTABLE = T.rows",
    "a pattern": "TABLE = []\nfor e in [(0, 0), (1, -1)]:\n    match e:\n        case (n, s):\n"
    "            TABLE.insert(n, s)",
    "a lambda with a parameter": "TABLE = {}\nany(map(lambda e: TABLE.__setitem__(*e), [(1, -1)]))",
    "a name that a function binds": "def begin():\n    global TABLE\n    TABLE = [0, -1]\nif True:\n    begin()",
}
ONLY_SHOWN = [
    "print(TABLE)", "plt.plot(TABLE)", "for row in TABLE:\n    print(row, np.mean(TABLE))", "ax.plot(x, TABLE)",
    "lines = ax.plot(TABLE)\nlines[0].set_data(1, 2)", "draw(ax, TABLE)", "while True:\n    plt.pause(0.1)",
    "for n in range(9):\n    ax.plot(np.asarray(TABLE) * n)\n    plt.pause(STEP)", "display(TABLE)",
    "if len(TABLE) > 1:\n    plt.title(f'{TABLE[0]}')", "x = np.linspace(0, 1)\nx[0] = 3\nplt.plot(x)",
    "y = [TABLE[1] * n for n in range(3)]\ny.append(2)", "time.sleep(STEP)", "other = TABLE.copy()\nother[0] = 7",
    "x = TABLE\nx = [1, 2]\nx[0] = 7", "with plt.style.context('dark'):\n    plt.plot(TABLE)", "sorted(TABLE)",
    "try:\n    widget.show(TABLE)\nexcept Exception:\n    print('no widget')", "assert np.allclose(TABLE, TABLE)",
    "lab.expose(1, 2)", "run(TABLE)", "total = np.sum(TABLE)\nprint(total)", "y = copy.deepcopy(TABLE)\ny[0] = 3",
    "if __name__ == '__main__':\n    run(TABLE)",
    "lab.run(lambda: TABLE)", "frames = path(TABLE)\nframes.append(3)\nplt.plot(frames)",
    "anim = FuncAnimation(fig, draw, frames=TABLE)\nanim.save('x.mp4')",
]  # fmt: skip
"""Statements that change nothing of what a function needs."""


@pytest.mark.parametrize("name", FILLED)
def test_a_table_is_filled_however_that_is_written(name, tmp_path):
    submission = handed_in(tmp_path, FILLED[name] + USED, "lab.py")
    assert defined(submission)["rebound_velocity"](-2.0, 0.5) == 1.0


@pytest.mark.parametrize("shown", ONLY_SHOWN)
def test_what_only_shows_a_table_is_left_out(shown, tmp_path):
    before = (
        "import time\nimport numpy as np\nimport matplotlib.pyplot as plt\nfrom labs import lab\nSTEP = 0.1\n"
        "import copy\nTABLE = [0, -1]\ndef draw(ax, table):\n    ax.plot(table)\nfig, ax = plt.subplots()\n"
        "def run(t):\n    fig, ax = plt.subplots()\n    for n in t:\n        ax.plot(n)\n        plt.pause(0.1)\n"
        "def path(t):\n    p = []\n    for n in range(9):\n        p.append(t[0] + n * t[1])\n    return p\n"
    )
    text = handed_in(tmp_path, before + shown + USED, "lab.py").text
    assert [line for line in text.splitlines() if line] == ["TABLE = [0, -1]", *USED.strip().splitlines()]


RIGHT = """
import numpy as _np
def normal_velocity(body_a, body_b, normal):
    (va, wa, ra), (vb, wb, rb) = body_a[:3], body_b[:3]
    return -TABLE[1] * _np.sum((va + _np.cross(wa, ra) - vb - _np.cross(wb, rb)) * normal, axis=-1)
"""
WITH_PLOTS = {
    "a loop that plots": "import matplotlib.pyplot as plt\nTABLE = [0, 0]\nfig, ax = plt.subplots()\n"
    "for n in range(2):\n    ax.plot(TABLE)\n    TABLE[n] = -n\n    plt.pause(0.1)\nplt.show()",
    "a loop that shows": "from labs import lab\nTABLE = [0, 0]\nlab.begin('impulse')\nfor n in range(2):\n"
    "    lab.show(TABLE)\n    TABLE[n] = -n",
    "a question": "TABLE = [0, -1]\nTABLE[0] = input('How many?')",
    "an end": "TABLE = [0, 0]\nfor n in range(2):\n    TABLE[n] = -n\nexit()",
}
WRONG = {
    "a loop": "TABLE = [0, 0]\nfor n in range(2):\n    TABLE[n] = -3 * n",
    "an alias": "TABLE = [0, -1]\nalias = TABLE\nalias[1] = -5",
    "deletion": "TABLE = [0, -1, -7]\ndel TABLE[1]",
    "a helper": "TABLE = [0, -1]\ndef empty(table):\n    table.clear()\nempty(TABLE)",
    "a swap": "TABLE = [0, -1]\nTABLE[0], TABLE[1] = TABLE[1], TABLE[0]",
}


@pytest.mark.slow
def test_a_right_table_earns_all_points_and_a_wrong_one_none(tmp_path):
    with Grader() as grader:
        for name, text in (FILLED | WITH_PLOTS).items():
            sheet = sheet_of(tmp_path, grader, text + RIGHT, "normal_velocity")
            assert report.all_right(sheet), (name, sheet.complaints)
        for name, text in WRONG.items():
            assert sheet_of(tmp_path, grader, text + RIGHT, "normal_velocity").earned == 0, name


@pytest.mark.parametrize(
    ("filling", "line"),
    [
        ("import helper\nTABLE = {}\nhelper.fill(TABLE)", 3),
        ("from helper import fill\nTABLE = []\nfill(TABLE)", 3),
        ("import numpy as np\nimport helper\nTABLE = np.zeros(3)\nfor n in range(3):\n    helper.put(n, TABLE)", 4),
        ("import helper\nTABLE = dict()\nTABLE.update(helper.rows())", 3),
    ],
)
def test_a_table_that_stays_empty_names_what_would_fill_it(filling, line, tmp_path):
    (complaint,) = [each for each in handed_in(tmp_path, filling + USED, "lab.py").complaints if each.kind == "other"]
    assert (complaint.line, "TABLE stays as line" in complaint.text) == (line, True)


@pytest.mark.parametrize(
    "shown",
    [
        "TABLE = {}\nTABLE[1] = -1\nplt.plot(TABLE)",
        "TABLE = {1: -1}\nplt.plot(TABLE)",
        "TABLE = {}\nprint(TABLE)",
        "TABLE = {}\ndef note(n):\n    TABLE[n] = -n\nfor n in range(2):\n    note(n)\nplt.plot(TABLE)",
    ],
)
def test_nothing_is_said_of_a_table_that_is_filled_and_then_shown(shown, tmp_path):
    submission = handed_in(tmp_path, "import matplotlib.pyplot as plt\n" + shown + USED, "lab.py")
    assert [each for each in submission.complaints if each.kind == "other"] == []
