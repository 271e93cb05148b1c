# Everything runs in .venv; `make demo` and `make test` set it up themselves.
PYTHON ?= python3
BIN := .venv/bin
STAMP := .venv/.installed
# Tests over two processes; those that share a fixture stay together.
SPREAD := -n 2 --dist loadgroup

.PHONY: setup compiled compiled-sim compiled-rig demo test quick fuzz coverage check format bench docs package clean

# Modules are compiled by all cores, which pip does one after the other; what cannot be compiled is left to its import.
setup: $(STAMP)

$(STAMP): pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile -c constraints.txt -e ".[dev,docs]"
	-$(BIN)/python -m compileall -qq -j 0 -x /tests/ .
	touch $(STAMP)

demo: $(STAMP)
	CI=1 $(BIN)/needle demo --out out/demo --force

# Compiled once, before processes would each do it; simulation and independent rig side by side.
compiled: $(STAMP)
	$(MAKE) --no-print-directory -j2 compiled-sim compiled-rig

compiled-sim:
	$(BIN)/python -c "from sim.simulation import prepare_processes; prepare_processes()"

compiled-rig:
	$(BIN)/python -c "from validation.rig.simulation import compile_kernels; compile_kernels()"

test: compiled
	CI=1 $(BIN)/python -m pytest $(SPREAD)

quick: compiled
	CI=1 $(BIN)/python -m pytest $(SPREAD) -m "not slow"

# Ten thousand wrong inputs, and how each ended.
fuzz: compiled
	CI=1 PYTHONPATH=.:tests $(BIN)/python -m fuzz.run --inputs 11000

coverage: compiled
	CI=1 $(BIN)/python -m pytest --cov --cov-report=term-missing:skip-covered

check: $(STAMP)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy

format: $(STAMP)
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

bench: $(STAMP)
	CI=1 $(BIN)/python -m benchmarks.run --out out/bench

docs: $(STAMP)
	$(BIN)/python -m sphinx --fail-on-warning --keep-going --quiet docs out/docs
	@echo "wrote      out/docs/index.html"

package: $(STAMP)
	.ci/package $(BIN)/python out/dist

clean:
	rm -rf .venv out *.egg-info
