# `make report` and `make test` are all a newcomer needs: both create the environment first.
PYTHON ?= $(shell command -v python3.11 || command -v python3 || command -v python)
VENV   ?= .venv
OUT    ?= report
BIN    := $(VENV)/bin
READY  := $(VENV)/.installed

.PHONY: help install report test docs verify lint clean
help:            ## list the targets
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed 's/:.*## /\t/'

install: $(READY) ## create the environment and install the lab into it
$(READY): pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	PIP_CONSTRAINT=constraints.txt $(BIN)/python -m pip install --quiet --disable-pip-version-check -e '.[engines,dev]'
	PIP_CONSTRAINT=constraints.txt $(BIN)/python -m pip install --quiet --disable-pip-version-check -e '.[crowd]' \
		|| echo "navground has no wheel for this machine; the tests that compare with it are skipped"
	PIP_CONSTRAINT=constraints.txt $(BIN)/python -m pip install --quiet --disable-pip-version-check -e '.[dart]' \
		|| echo "DART has no wheel for this machine; its rows will say 'not available'"
	touch $(READY)

report: $(READY) ## compare the four implementations and write the report
	$(BIN)/collisions report --out $(OUT)

test: $(READY)   ## the tests, in a few minutes
	$(BIN)/python -m pytest -n auto --dist loadfile

lint: $(READY)   ## style and types
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

docs: $(READY)   ## draw the figures of the statements and write their page
	$(BIN)/python docs/figures/draw.py
	$(BIN)/python docs/statement_table.py

verify: lint     ## the slow checks: style, types, the whole catalogue, the whole report
	$(BIN)/python -m pytest -n auto --dist loadfile -m slow --timeout=1200

clean:           ## remove the environment and what was built
	rm -rf $(VENV) $(OUT) .pytest_cache .mypy_cache .ruff_cache .hypothesis
