"""`python -m labs …`, for a terminal that does not find `collisions`."""

from labs.cli import main

if __name__ == "__main__":
    main()
