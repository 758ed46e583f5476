"""The README of a release, in the order in which a student follows it."""

from __future__ import annotations

from collections.abc import Sequence

from reference import lecture


def readme(folder: str, labs: Sequence[str]) -> str:
    """The text for a release with these labs, which unpacks to that folder."""
    titles = "\n".join(f"- `labs/notebooks/{name}.ipynb`: *{lecture.topic(name).title}*" for name in labs)
    return _README.format(folder=folder, titles=titles, first=labs[0])


_README = """\
# Collisions Lab

{titles}

A lab is a notebook. You predict, derive, write a few functions, check them, and run them beside physics engines. The
labs follow the slides of *Collisions*, a lecture by Rick Parent at The Ohio State University (CIS 682). What a slide
says is quoted with its number; where a slide is wrong, the lab shows a counterexample.

## On your own machine

You need Python 3.11 or later (`python --version` says which you have). All commands go into a terminal.

1. Unpack the archive and go into its folder:

   ```sh
   unzip {folder}.zip
   cd {folder}
   ```

2. Make an environment and install the lab into it, once. It takes a minute or two.

   On Linux and macOS:

   ```sh
   python3 -m venv .venv
   source .venv/bin/activate
   python -m pip install -c constraints.txt -e ".[notebooks,engines]"
   ```

   On Windows, in PowerShell:

   ```sh
   py -m venv .venv
   .venv\\Scripts\\activate
   python -m pip install -c constraints.txt -e ".[notebooks,engines]"
   ```

3. Open the notebook:

   ```sh
   jupyter lab labs/notebooks/{first}.ipynb
   ```

   Run the first cell. It says which engines run on your machine.

In a new terminal, go into the folder again, repeat the line with `activate`, and open the notebook.

PyBullet has ready-made packages for Python 3.11 on Linux only; elsewhere MuJoCo alone is installed. Nothing is lost:
an engine that is not installed is shown from recordings.

## On Colab

Open a notebook from `labs/notebooks` there, run its first cell, and choose `{folder}.zip` when it asks for a file.

## Without opening the notebook

```sh
collisions check labs/notebooks/{first}.ipynb
```

checks the functions that you have written. If the terminal does not find `collisions`, use
`python -P -m labs check labs/notebooks/{first}.ipynb`.
"""
