#!/usr/bin/env bash
# PrairieLearn runs this as root in a container for each submission. The grader runs the submission's functions as
# `nobody`, each test in a process of its own. If grading fails, there is no results.json, and PrairieLearn says so.
set -euo pipefail
root="${GRADE_ROOT:-/grade}"
project="$root/tests/project"
mkdir -p "$root/results"
rm -rf "$root/results/results.json"
chmod -R o= "$root/tests" "$root/results" "$root/student"
if [ -d "$root/data" ]; then
    chmod -R o= "$root/data"
fi
cd "$project"
exec env -i PATH="$PATH" PYTHONPATH="$project" PYTHONDONTWRITEBYTECODE=1 \
    python3 -P -m labs.gradebook.platforms.prairielearn "$root" "$(cat "$root/tests/lab.txt")"
