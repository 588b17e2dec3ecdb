# make lab opens the course, make test runs every test; both set up what they need.

# The first suitable Python, unless one is named: make lab PYTHON=python3.12
ifndef PYTHON
PYTHON := $(shell for p in python3 python3.13 python3.12 python3.11 python; do \
	$$p -B -c 'import lab, sys; sys.exit(not lab.supported())' >/dev/null 2>&1 && echo $$p && exit; \
	done; echo python3)
endif

ENV = .venv-test
RUN = PATH="$(CURDIR)/$(ENV)/bin:$$PATH" $(ENV)/bin/python -m
FAULTS = $(ENV)/figure_faults.txt
# one worker a core of a small machine; files stay whole, in the order of tests/conftest.py
PYTEST = $(RUN) pytest -n 2 --dist loadfile --no-loadscope-reorder

.PHONY: lab test test-all soak env clients lint format notebooks site student lecturer bench lock clean

lab:  ## Set up and open the course; LAB_ARGS="--no-browser --port 9999" go to JupyterLab
	@$(PYTHON) lab.py $(LAB_ARGS)

test: lint clients  ## Set up, run every test that is not long, and every notebook; TEST_ARGS go to pytest
	$(PYTEST) -m "not soak and not walk and not slow" $(TEST_ARGS)
	rm -f $(FAULTS)
	PYTHONHASHSEED=0 SLAMLAB_FIGURE_FAULTS="$(CURDIR)/$(FAULTS)" \
		$(RUN) pytest -p tests.notebooks.nearly @tests/notebooks/nbval.args notebooks exercises solutions
	$(RUN) course.known_faults $(FAULTS)

LONG = slow or walk
test-all: test  ## Also the long tests: every notebook in a real browser, the site, a whole department
	$(PYTEST) -m "($(LONG)) and not soak" $(ALL_ARGS)

soak: env  ## Run what takes long, or needs a machine that has nothing else to do
	$(RUN) pytest -m soak
	SLAMLAB_SLIP_SEEDS=100 $(RUN) pytest -n 2 tests/grading/test_slips.py

env:
	@$(PYTHON) lab.py --venv $(ENV) --lock requirements-test.lock --install-only

clients: env  # only built from source, so in no lock; without them their tests are skipped
	@$(RUN) pip install --quiet --no-deps --require-hashes -r tests/devices/clients.txt || \
		echo "these clients could not be installed: their tests will be skipped"

lint: env
	$(RUN) ruff check .
	$(RUN) ruff format --check .

format: env
	$(RUN) ruff check --fix .
	$(RUN) ruff format .

notebooks: env  ## Derive notebooks/, exercises/ and solutions/ from course/
	$(RUN) course.build

site: env  ## Build the course's site into site/; needs Node.js for the formulas
	$(RUN) course.site

student: env  ## Pack what students get into slam-course.zip: no solutions; needs Node.js for the lessons' pages
	$(RUN) course.pack

lecturer: env  ## Pack what lecturers get into slam-course-lecturer.zip: solutions and notes
	$(RUN) course.pack --lecturer

bench: env  ## Run every benchmark; BENCH_ARGS="--quick --json FILE"
	$(RUN) benchmarks $(BENCH_ARGS)

# Compile both locks together, keeping what is locked already; LOCK_ARGS=--upgrade renews.
# Needs uv (pip install uv). The smaller lock takes its versions from the larger one.
UV ?= uv
COMPILE = echo 'flit_core>=3.12,<4' | $(UV) pip compile --quiet --universal --python-version 3.11 \
	--generate-hashes --no-emit-index-url --no-emit-find-links --no-header --no-annotate
lock:
	$(COMPILE) $(LOCK_ARGS) --all-extras pyproject.toml - -o requirements-test.lock
	$(COMPILE) -c requirements-test.lock pyproject.toml - -o requirements.lock

clean:  ## Remove the environments and every cache
	rm -rf .venv .venv-test .pytest_cache .ruff_cache .hypothesis build dist
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
