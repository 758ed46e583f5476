# `make report` and `make test` are all a newcomer needs: both create the environment first.
# The newest Python for which all engines have packages, and which can make an environment.
PYTHON ?= $(shell for each in python3.13 python3.12 python3.11 python3 python; do \
	"$$each" -c 'import ensurepip' 2> /dev/null && { command -v "$$each"; break; }; done)
NEEDS_PYTHON = $(error No Python from 3.11 on that can make an environment. Install one, or name it: make PYTHON=...)
VENV   ?= .venv
OUT    ?= report
# Which extras to install; `make test EXTRAS=dev OPTIONAL= VENV=.venv-bare` tries the lab without any engine.
EXTRAS ?= mujoco,dev
# Extras that some machines have no wheel for, which must not stop an install.
OPTIONAL ?= crowd dart
# More for pytest, as in `make test ARGS="-k friction"`.
ARGS   ?=
BIN    := $(VENV)/bin
# A worker takes tests in their order, so those of one file share what they have computed; an idle one takes over some.
# One that crashes ends the run, and its test is named.
PYTEST := $(BIN)/python -m pytest -n auto --dist worksteal --max-worker-restart=0
READY  := $(VENV)/.installed
# The last of the files that `make docs` writes. The lessons that they come from are read with a package of `dev`.
BUILT  := $(if $(findstring dev,$(EXTRAS)),docs/symbols.md)
QUIET  := --quiet --disable-pip-version-check
INSTALL := PIP_CONSTRAINT=constraints.txt $(BIN)/python -m pip install $(QUIET)

# Many processes import the same modules: they are compiled once.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: help install report test docs verdicts live verify weekly baseline lint clean
help:            ## list the targets
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed 's/:.*## /\t/'

install: $(READY) $(BUILT) ## create the environment, install the lab into it, and write what git does not keep
$(READY): pyproject.toml constraints.txt bullet.txt
	$(or $(PYTHON),$(NEEDS_PYTHON)) -m venv --clear $(VENV)
	$(if $(findstring mujoco,$(EXTRAS)),$(BIN)/python -m pip install $(QUIET) --no-deps --require-hashes -r bullet.txt \
		|| echo "PyBullet has no package for this machine; the lab works without it.")
	$(INSTALL) -e '.[$(EXTRAS)]'
	for extra in $(OPTIONAL); do \
		$(INSTALL) -e ".[$$extra]" || echo "The extra $$extra has no wheel for this machine; the lab works without it."; \
	done
	touch $(READY)

report: $(READY) ## compare the four implementations and write the report
	$(BIN)/collisions report --out $(OUT)

test: $(READY) $(BUILT) ## the tests, in a few minutes
	$(PYTEST) --cpu-allowed=150 $(ARGS)

lint: $(READY)   ## style and types
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

docs: $(READY)   ## draw the figures, and write the solved notebooks and the pages that come from code
	$(BIN)/python docs/build.py
docs/symbols.md: $(READY) $(wildcard labs/lessons/*.md labs/hints/*.md docs/figures/*.py reference/lecture/*.py)
	$(BIN)/python docs/build.py

verdicts: $(READY) ## count what each implementation made of the scenarios, for the page of the statements
	$(BIN)/python docs/statement_engines.py

live: $(READY)   ## run every scenario in every engine once, for the slow checks to read
	$(BIN)/python tests/suite/live.py

verify: lint live $(BUILT) ## the slow checks: style, types, the whole catalogue, the whole bank of mistakes, the notebooks
	$(PYTEST) -m 'slow and not weekly' --hypothesis-profile=more --timeout=1200 --cpu-allowed=600 $(ARGS)

weekly: live $(BUILT) ## the rest: more points of the grids, other seeds, other people's graders and platforms, faults in our code
	$(PYTEST) -m weekly --timeout=2400 --cpu-allowed=400 $(ARGS)
	$(PYTEST) -m 'hypothesis and not weekly' --hypothesis-profile=others --hypothesis-seed=41 $(ARGS)
	$(BIN)/python tests/faults/study.py run

baseline: $(READY) $(BUILT) ## what people receive, compared with the checksums that are kept
	$(BIN)/python tests/baseline/make.py --out .baseline

clean:           ## remove the environment and what was built
	rm -rf $(VENV) $(OUT) .live .baseline .pytest_cache .mypy_cache .ruff_cache .hypothesis
	rm -rf docs/course.md docs/statements.md docs/symbols.md docs/instructors docs/images/engines docs/images/statements
	rm -f labs/figures/*.svg solutions/notebooks/*.ipynb
