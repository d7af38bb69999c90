# make book | test | check-book | lab | pdf | archive | maps | window | bench | lint | clean,
# and for the maintainer: make reproducible | mutants | record | environment | baselines | headline
# Each makes the environment .venv from environment.txt when it is missing or stale; nothing is installed elsewhere.
PYTHON ?= python3
BIN := .venv/bin
READY := .venv/ready
BENCH := .venv-bench
PEERS := diffrax heyoka jitcode pynamicalsys
# Chapters read side by side. Their cells use all cores by themselves: more than two gains little.
JOBS ?= 2

# JupyterLab opens a chapter (.md) as a notebook and asks nobody for news; kept in .venv, so no other project notices.
LAB_SETTINGS := .venv/etc/jupyter/labconfig/default_setting_overrides.json
LAB_DEFAULTS := { \
    "@jupyterlab/docmanager-extension:plugin": {"defaultViewers": {"markdown": "Jupytext Notebook"}}, \
    "@jupyterlab/apputils-extension:notification": {"fetchNews": "false", "checkForUpdates": false}}

.PHONY: book test check-book lab bench record maps window reproducible mutants pdf archive lint clean environment baselines headline

book: $(READY)
	@$(BIN)/python book/sphinx/build.py $(JOBS)

test: $(READY)
	$(BIN)/python -m pytest --numprocesses=2 --dist=loadfile

lab: $(READY)
	$(BIN)/jupyter lab --notebook-dir=. --LabApp.default_url=/lab/tree/chapters/index.md $(LAB_OPTIONS)

# Side by side with other packages, which have an environment of their own; `make bench QUICK=--quick` for a first look.
bench: $(BENCH)/ready
	$(BENCH)/bin/python -m benchmarks $(QUICK)
	$(BENCH)/bin/python benchmarks/scale.py

# The dated measurement that the chapter on speed shows.
record: $(BENCH)/ready
	$(BENCH)/bin/python -m benchmarks --record benchmarks/results.json

# The built book in Chromium with the network cut.
check-book: $(READY)
	$(BIN)/python -m pytest tests/browser --numprocesses=2

# The whole book as one PDF, and as a checksummed zip for a repository of record.
pdf: book
	$(BIN)/python tools/pdf.py

archive: book
	$(BIN)/python tools/archive.py

# Planes and basins at full resolution into _build/maps: hours on two cores; an interrupted run goes on where it was.
maps: $(READY)
	$(BIN)/python tools/maps.py
	$(BIN)/python tools/maps_basins.py 512
	$(BIN)/python tools/maps_transients.py

# Two runs of the chapters, on one thread and on several: the same numbers bit for bit.
reproducible: $(READY)
	$(BIN)/python tools/reproducible.py

# Deliberate errors, one at a time: each must turn the suite red.
mutants: $(READY)
	$(BIN)/python tools/mutants.py

# The window of chaos from 200 starts instead of the book's 32: some minutes.
window: $(READY)
	$(BIN)/python tools/window.py

# The picture in the README.
headline: $(READY)
	$(BIN)/python tools/headline.py

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

# Everything that the other targets make, except the environment (rm -rf .venv).
clean:
	rm -rf _build .pytest_cache .ruff_cache .hypothesis
	find . \( -name .venv -o -name .venv-bench \) -prune -o -name __pycache__ -prune -exec rm -rf {} +

# The reference data and images of the figures, after a change that is meant to alter them.
baselines: $(READY)
	$(BIN)/python -m pytest tests/test_figures.py --regenerate

# Pins every package anew from pyproject.toml, keeping the present versions where they still fit (delete environment.txt
# first to update all). The maintainer's own target, and the only one that needs uv: it resolves for all systems at once.
environment:
	grep -sv '^-e' environment.txt >environment.new || true
	uv pip compile --quiet --universal --python-version 3.11 --fork-strategy fewest --no-annotate --no-header \
	    --extra book --extra cluster --extra test pyproject.toml -o environment.new
	{ echo '# Every package pinned, for Python 3.11 to 3.13 on Linux and on macOS (Arm). Compiled from pyproject.toml by `make environment`.'; \
	    cat environment.new; echo '-e .'; } >environment.txt
	rm environment.new
	grep -v '^-e' environment.txt >pins.new
	uv pip compile --quiet --universal --python-version 3.11 --fork-strategy fewest --no-annotate --no-header \
	    --extra bench -c pins.new pyproject.toml -o benchmarks.new
	{ sed -n '/^#/p' benchmarks/environment.txt; cat benchmarks.new; } >pins.new
	mv pins.new benchmarks/environment.txt && rm benchmarks.new

# A changed environment.txt makes a new .venv, and so does an installation that did not come to its end; a changed
# pyproject.toml alone installs the package anew.
$(READY): environment.txt pyproject.toml
	@rm -f $@
	@$(PYTHON) -c 'import sys; v = sys.version_info[:2]; (3, 11) <= v <= (3, 13) or sys.exit( \
	    f"Python 3.11, 3.12 or 3.13 is needed, and $(PYTHON) is {v[0]}.{v[1]}. Name another: make PYTHON=python3.12 ...")'
	@if cmp -s environment.txt .venv/installed; then \
	    $(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps -e .; \
	else \
	    echo "Making .venv from environment.txt: about two minutes, 1 GB" && rm -rf .venv && $(PYTHON) -m venv .venv && \
	    $(BIN)/python -m pip install --quiet --disable-pip-version-check -r environment.txt && cp environment.txt .venv/installed; \
	fi
	@mkdir -p $(dir $(LAB_SETTINGS)) && echo '$(LAB_DEFAULTS)' >$(LAB_SETTINGS)
	@touch $@

$(BENCH)/ready: benchmarks/environment.txt pyproject.toml
	@echo "Making $(BENCH) for the benchmarks: some minutes, 1.5 GB" && rm -rf $(BENCH) && $(PYTHON) -m venv $(BENCH)
	@$(BENCH)/bin/python -m pip install --quiet --disable-pip-version-check -c benchmarks/environment.txt -e '.[cluster]'
	@for peer in $(PEERS); do \
	    $(BENCH)/bin/python -m pip install --quiet --disable-pip-version-check -c benchmarks/environment.txt $$peer || \
	    echo "$$peer cannot be installed here: the benchmarks leave it out"; \
	done
	@touch $@
