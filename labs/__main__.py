"""`python -m labs …`, for a terminal that does not find `collisions`.

Python looks for modules in the working directory first, where a student may have a `numpy.py` or a `random.py`. So that
directory is moved behind all others before anything else is imported. A `labs.py` there would be run in place of this
file: `python -P -m labs …` leaves the directory out from the start.
"""

import os
import sys

if not sys.flags.safe_path and sys.path[:1] == [os.getcwd()]:
    sys.path.append(sys.path.pop(0))

from labs.cli import main

if __name__ == "__main__":
    main()
