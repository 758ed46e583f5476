"""The README of a release, in the order in which a student follows it."""

from __future__ import annotations

import shlex
from collections.abc import Sequence

from reference import lecture


def readme(folder: str, labs: Sequence[str], archive: str = "") -> str:
    """The text for a release with these labs. archive: the file's name; it unpacks to that folder.

    Without an archive the release is a folder of any name.
    """
    titles = "\n".join(f"- `labs/notebooks/{name}.ipynb`: *{lecture.topic(name).title}*" for name in labs)
    unpack = _UNPACK.format(folder=folder, archive=archive, command=shlex.quote(archive)) if archive else _GO
    chosen = f"`{archive}`, the archive that you were given," if archive else "the archive that you were given"
    whole = _WHOLE if {topic.name for topic in lecture.TOPICS} <= set(labs) else ""
    return _README.format(unpack=unpack, chosen=chosen, titles=titles, first=labs[0], whole=whole)


_UNPACK = """\
1. Unpack `{archive}`, the archive that you were given, and go into its folder:

   ```sh
   unzip {command}
   cd {folder}
   ```
"""
_GO = """\
1. If you were given an archive, unpack it. Go into the folder that holds this file (`cd` with the folder's name).
"""


_WHOLE = """
## Where this leads

When you have done all ten labs, you have written a physics engine out of a lecture: forces, detection, impacts,
friction, rest, and the loop that puts them together. This is what such an engine can do; every state in the picture was
computed by a `step_world` of the last lab, with the forces of the seventh:

![A heap between walls, a jelly that falls, and a brick that turns over.](labs/figures/own_engine.svg)

Yours runs beside PyBullet, MuJoCo and DART:

    collisions compare cradle --profile world --implementation labs/notebooks/world.ipynb

At the end of `world.ipynb` are four projects to take it further, each with a rubric: a superball, a domino row, cloth
on a heap, and a crowd through a door.
"""
_README = """\
# Collisions Lab

{titles}

A lab is a notebook. You predict, derive, write a few functions, check them, and run them beside physics engines. The
labs follow the slides of *Collisions*, a lecture by Rick Parent at The Ohio State University (CIS 682). What a slide
says is quoted with its number; where a slide is wrong, the lab shows a counterexample.
{whole}
## On your own machine

You need Python 3.11 or later (`python --version` says which you have). All commands go into a terminal.

{unpack}
2. Make an environment and install the lab into it, once. It takes a minute or two.

   On Linux and macOS:

   ```sh
   python3 -m venv .venv
   source .venv/bin/activate
   python -m pip install --no-deps --require-hashes -r bullet.txt
   python -m pip install -c constraints.txt -e ".[notebooks,mujoco]"
   python -m pip install -c constraints.txt -e ".[dart]"
   ```

   On Windows, in PowerShell:

   ```sh
   py -m venv .venv
   .venv\\Scripts\\activate
   python -m pip install --no-deps --require-hashes -r bullet.txt
   python -m pip install -c constraints.txt -e ".[notebooks,mujoco]"
   python -m pip install -c constraints.txt -e ".[dart]"
   ```

3. Open the notebook:

   ```sh
   jupyter lab labs/notebooks/{first}.ipynb
   ```

   Run the first cell. It says whether PyBullet and MuJoCo run on your machine. `collisions engines` has DART as well.

In a new terminal, go into the folder again, repeat the line with `activate`, and open the notebook.

Python 3.12 and 3.13 can have all three engines, PyBullet, MuJoCo and DART, on Windows, on newer Macs and on Linux with
an x86-64 processor; so can 3.11 there. The line with `bullet.txt` is for PyBullet and the last one for DART. If one of
them fails, go on: an engine that is not installed is shown from recordings, and nothing is lost.

## On Colab

Open a notebook from `labs/notebooks` there, run its first cell, and choose {chosen} when it asks for a file.

## Without opening the notebook

```sh
collisions check labs/notebooks/{first}.ipynb
```

checks the functions that you have written. If the terminal does not find `collisions`, use
`python -P -m labs check labs/notebooks/{first}.ipynb`.
"""
