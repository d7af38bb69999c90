# make book | test | check | check-book | proof | proof-first | lab | pdf | archive | maps | bench | lint | clean,
# and for the maintainer: make reproducible | mutants | elsewhere | slow | record | environment | baselines
# Each makes the environment .venv from environment.txt when it is missing or stale; nothing is installed elsewhere.
# The same without make: the README's plain commands.
PYTHON ?= python3
BIN := .venv/bin
READY := .venv/ready
# The Pythons that are tested, oldest and newest, as pyproject.toml names them.
PYTHONS = $(shell sed -n 's/.*"Programming Language :: Python :: \(3\.[0-9]*\)".*/\1/p' pyproject.toml)
OLDEST = $(firstword $(PYTHONS))
NEWEST = $(lastword $(PYTHONS))
BENCH := .venv-bench
PEERS := diffrax heyoka jitcode pynamicalsys
# Chapters read side by side. Their cells use all cores by themselves: more than two gains little.
JOBS ?= 2

# JupyterLab opens a chapter (.md) as a notebook and asks nobody for news; kept in .venv, so no other project notices.
LAB_SETTINGS := .venv/etc/jupyter/labconfig/default_setting_overrides.json
LAB_DEFAULTS := { \
    "@jupyterlab/docmanager-extension:plugin": {"defaultViewers": {"markdown": "Jupytext Notebook"}}, \
    "@jupyterlab/apputils-extension:notification": {"fetchNews": "false", "checkForUpdates": false}}

# Nothing personal reaches what make starts: no packages or start-up files from elsewhere, no installation outside .venv,
# no other encoding or language. What kernels and tests look up at home besides: book/sphinx/isolation.py.
unexport $(filter-out PYTHON,$(filter PYTHON%,$(.VARIABLES))) PIP_TARGET PIP_PREFIX PIP_ROOT
export PYTHONNOUSERSITE := 1
export PYTHONUTF8 := 1
export PIP_USER := 0
export LC_ALL := C

# An environment holds the path that it was made at: in a moved or copied checkout it is made anew; and so is it for
# another Python than its own, where one is named: make PYTHON=python3.12 ...
$(foreach env,.venv $(BENCH),$(shell [ "$$(cat $(env)/place 2>/dev/null)" = "$$(pwd -P)" ] || rm -f $(env)/ready $(env)/installed))
ifeq ($(origin PYTHON),command line)
$(shell [ "$$($(BIN)/python -V 2>&1)" = "$$($(PYTHON) -V 2>&1)" ] || rm -f $(READY) .venv/installed)
endif

.PHONY: book test check slow check-book proof proof-first lab bench record maps reproducible mutants elsewhere pdf archive lint clean \
    environment baselines

book: $(READY)
	@$(BIN)/python book/sphinx/build.py $(JOBS)

test: $(READY)
	$(BIN)/python -m pytest --numprocesses=2 --dist=loadfile

# The core of the tests: a minute or two.
check: $(READY)
	$(BIN)/python -m pytest --numprocesses=2 --dist=loadfile -m "not slow"

# Which tests are slow, after a change that made some so: as measured by the last `make test`.
slow: $(READY)
	$(BIN)/python book/sphinx/run_report.py

# The theorem, proved by ball arithmetic.
proof: $(READY)
	$(BIN)/python -m proof

# That no smaller forcing has a tangency: up to half an hour more.
proof-first: $(READY)
	$(BIN)/python -m proof --first

lab: $(READY)
	$(BIN)/python -m jupyter lab --notebook-dir=. --LabApp.default_url=/lab/tree/chapters/index.md $(LAB_OPTIONS)

# Side by side with other packages, which have an environment of their own; `make bench QUICK=--quick` for a first look.
bench: $(BENCH)/ready
	$(BENCH)/bin/python -m benchmarks $(QUICK)

# The dated measurement that the chapter on speed shows.
record: $(BENCH)/ready
	$(BENCH)/bin/python -m benchmarks --record book/studies/speed.json

# The built book in Chromium with the network cut.
check-book: $(READY)
	$(BIN)/python -m pytest tests/browser --numprocesses=2

# The whole book as one PDF, and as a checksummed zip for a repository of record.
pdf: book
	$(BIN)/python tools/pdf.py

archive: book
	$(BIN)/python tools/archive.py

# Planes, basins and transients at full resolution into _build/maps: hours on two cores; an interrupted run goes on where
# it was. `make maps WHAT=candidates`: the candidates for alpha and omega on a finer grid, some minutes; WHAT=window: the
# window of chaos from 200 starts, some minutes; WHAT=headline: the README's picture.
maps: $(READY)
	$(BIN)/python tools/maps.py $(WHAT)

# Two runs of the chapters, on one thread and on several: the same numbers bit for bit.
reproducible: $(READY)
	$(BIN)/python tools/reproducible.py

# Deliberate errors, one at a time: each must turn the suite red.
mutants: $(READY)
	$(BIN)/python tools/mutants.py

# The core of the tests and a small book as strangers would run them: no home, other settings, one processor, no network;
# and every chapter as a downloaded notebook beside an installed wheel.
elsewhere: $(READY)
	$(BIN)/python tools/elsewhere.py

# The project's own files: what a reader keeps beside them is his own affair.
SOURCES := benchmarks book duffing proof tests tools vectorized
lint: $(READY)
	$(BIN)/ruff check $(wildcard $(SOURCES))
	$(BIN)/ruff format --check $(wildcard $(SOURCES))

# Everything that the other targets make, except the environment (rm -rf .venv).
clean:
	rm -rf _build build *.egg-info .pytest_cache .ruff_cache .hypothesis
	find . \( -name .venv -o -name .venv-bench \) -prune -o -name __pycache__ -prune -exec rm -rf {} +

# The reference data and images of the figures, after a change that is meant to alter them; CASE=name for one of them.
baselines: $(READY)
	$(BIN)/python -m pytest tests/test_figures.py --regenerate $(if $(CASE),-k '[$(CASE)]')

# Pins every package anew from pyproject.toml, keeping the present versions where they still fit (delete environment.txt
# first to update all). The maintainer's own target, and the only one that needs uv: it resolves for all systems at once.
PIN := uv pip compile --quiet --universal --python-version $(OLDEST) --fork-strategy fewest --no-annotate --no-header
environment:
	grep -sv '^-e' environment.txt >environment.new || true
	$(PIN) --extra book --extra cluster --extra proof --extra test pyproject.toml -o environment.new
	{ echo '# Every package pinned, for Python $(OLDEST) to $(NEWEST) on Linux and on macOS (Arm). Compiled from pyproject.toml by `make environment`.'; \
	    cat environment.new; echo '-e .'; } >environment.txt
	rm environment.new
	grep -v '^-e' environment.txt >pins.new
	$(PIN) --extra bench -c pins.new pyproject.toml -o benchmarks.new
	{ sed -n '/^#/p' benchmarks/environment.txt; cat benchmarks.new; } >pins.new
	mv pins.new benchmarks/environment.txt && rm benchmarks.new

# A changed environment.txt makes a new .venv, and so does an installation that did not come to its end. Packages changed
# by hand (their folder is then younger) are put back to their pins; a changed pyproject.toml installs the package anew.
INSTALL := $(BIN)/python -m pip install --quiet --disable-pip-version-check
$(READY): environment.txt pyproject.toml $(wildcard .venv/lib/python3.*/site-packages)
	@rm -f $@
	@$(PYTHON) -c 'import sys; oldest, newest, name = sys.argv[1:]; here = "%d.%d" % sys.version_info[:2]; \
	    minor = lambda version: int(version.split(".")[1]); \
	    sys.version_info >= (3, minor(oldest)) or sys.exit("Python %s or newer is needed, and %s is %s. Name another: make PYTHON=python%s ..." % (oldest, name, here, newest)); \
	    minor(here) <= minor(newest) or print("Python %s is untested: the project is tested with %s to %s. Going on." % (here, oldest, newest))' $(OLDEST) $(NEWEST) $(PYTHON)
	@if ! cmp -s environment.txt .venv/installed; then \
	    echo "Making .venv from environment.txt: about two minutes, 1 GB" && rm -rf .venv && $(PYTHON) -m venv .venv && \
	    $(INSTALL) -r environment.txt && pwd -P >.venv/place && cp environment.txt .venv/installed; \
	elif ! $(BIN)/python tools/pins.py; then \
	    $(INSTALL) -r environment.txt; \
	elif [ -n "$(filter pyproject.toml,$?)" ]; then \
	    $(INSTALL) --no-deps -e .; \
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
	@pwd -P >$(BENCH)/place && touch $@
