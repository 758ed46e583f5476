#!/usr/bin/env bash
# Gradescope runs this once, as root, when it builds the image of the assignment. It needs the network.
set -euo pipefail
root="${AUTOGRADER_ROOT:-/autograder}"
project="$root/source/project"

# The first Python that is new enough and can make an environment; the fallback is what Ubuntu 24.04 and 22.04 offer.
find_python() {
    for name in python3.13 python3.12 python3.11 python3.14 python3; do
        if "$name" -c 'import sys, ensurepip, venv; sys.exit(sys.version_info < (3, 11))' > /dev/null 2>&1; then
            command -v "$name"
            return 0
        fi
    done
    return 1
}

# The environment lies beside the sources: a submission may read its modules, but nothing of the sources.
if [ ! -x "$root/python/bin/python" ]; then
    if ! python="$(find_python)"; then
        apt-get update
        apt-get install -y python3.12 python3.12-venv || apt-get install -y python3.11 python3.11-venv
        python="$(find_python)"
    fi
    "$python" -m venv "$root/python"
fi
"$root/python/bin/python" -m pip install --no-cache-dir --disable-pip-version-check \
    -c "$project/constraints.txt" -r "$project/requirements.txt"
"$root/python/bin/python" -m compileall -q "$project"
chmod -R o= "$root/source"
