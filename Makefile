# make lab opens the course, make test runs the tests; both install what they need.

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

HUB = /opt/slam-course

.PHONY: lab test test-all soak env clients lint format notebooks site student hub hub-env lecturer bench lock clean

lab:  ## Set up and open the course; LAB_ARGS="--no-browser --port 9999" go to JupyterLab
	@$(PYTHON) lab.py $(LAB_ARGS)

test: lint clients  ## Set up, run the quick tests and every notebook; TEST_ARGS go to pytest
	$(PYTEST) -m "not soak and not walk and not slow" $(TEST_ARGS)
	rm -f $(FAULTS)
	PYTHONHASHSEED=0 SLAMLAB_FIGURE_FAULTS="$(CURDIR)/$(FAULTS)" \
		$(RUN) pytest -p tests.course.notebooks.approximate_outputs @tests/course/notebooks/nbval.args notebooks exercises solutions
	$(RUN) course.known_figure_faults $(FAULTS)

LONG = slow or walk
test-all: test  ## Also the long tests: every notebook in a real browser, the site, a whole department
	$(PYTEST) -m "($(LONG)) and not soak" $(ALL_ARGS)

soak: env  ## Run the tests that take minutes on an otherwise idle machine
	$(RUN) pytest -m soak
	SLAMLAB_SLIP_SEEDS=10 $(RUN) pytest -n 2 tests/classroom/grading/test_mistakes.py

env:
	@$(PYTHON) lab.py --venv $(ENV) --lock requirements-test.lock --install-only

clients: env  # only built from source, so in no lock; without them their tests are skipped
	@$(RUN) pip install --quiet --no-deps --require-hashes -r tests/slamlab/devices/clients.txt || \
		echo "these clients could not be installed: their tests will be skipped"

lint: env
	$(RUN) ruff check .
	$(RUN) ruff format --check .

format: env
	$(RUN) ruff check --fix .
	$(RUN) ruff format .

notebooks: env  ## Derive notebooks/, exercises/ and solutions/ from course/
	$(RUN) course.build

site: env  ## Build the course's site into site/; needs Node.js for the formulas; SITE_ARGS go to course.site
	$(RUN) course.site $(SITE_ARGS)

student: env  ## Write the students' pack slam-course.zip, without solutions; needs Node.js for the lessons' pages
	$(RUN) course.pack

hub: hub-env  ## Install the course read-only for a JupyterHub into HUB (default: /opt/slam-course)
	npm ci --silent --prefix $(HUB)/classroom/hub/proxy

hub-env:
	$(PYTHON) -m course.pack --folder $(HUB)
	cp requirements-hub.lock $(HUB)
	cd $(HUB) && $(PYTHON) lab.py --venv env --lock requirements-hub.lock --install-only
	$(HUB)/env/bin/python -m compileall -q $(addprefix $(HUB)/,slamlab classroom course)

lecturer: env  ## Write the lecturers' pack slam-course-lecturer.zip, with solutions and notes
	$(RUN) course.pack --lecturer

bench: env  ## Run every benchmark; BENCH_ARGS="--quick --json FILE"
	$(RUN) benchmarks $(BENCH_ARGS)

# Compile all locks together, keeping what is locked already; LOCK_ARGS=--upgrade renews.
# Needs uv (pip install uv). The smaller locks take their versions from the largest one.
UV ?= uv
COMPILE = echo 'hatchling>=1.27,<2' | $(UV) pip compile --quiet --universal --python-version 3.11 \
	--generate-hashes --no-emit-index-url --no-emit-find-links --no-header --no-annotate \
	--no-emit-package slam-course-lab
HUB_PACKAGES = classroom/hub/requirements.in
lock:
	$(COMPILE) $(LOCK_ARGS) --all-extras pyproject.toml slamlab/pyproject.toml - -o requirements-test.lock
	$(COMPILE) -c requirements-test.lock --extra grading pyproject.toml - -o requirements.lock
	$(COMPILE) -c requirements-test.lock --extra grading pyproject.toml $(HUB_PACKAGES) - -o requirements-hub.lock

clean:  ## Remove the environments and every cache
	rm -rf .venv .venv-test .pytest_cache .ruff_cache .hypothesis build dist
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
