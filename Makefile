# `make demo` and `make test` do all the set-up on a fresh machine with Python 3.11 or newer.
PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready

# Tests start hundreds of processes: each would compile again all that it imports, and each core all tests.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: demo test suite lanes deep lint style types imports scripts browser bench steps mutate survivors fuzz guided golden pages site vsix extension windows lock release clean

demo: $(READY)
	$(BIN)/drycut run scenarios/keyhole -o out/keyhole
	@echo "open out/keyhole/report.html in a browser"

# Types take one core for most of a minute: the suite runs beside them. Scripts come first: tests of pages need what npm
# installs for them.
test: browser scripts
	@$(MAKE) --no-print-directory --jobs types style imports extension suite

# Each process begins with a run of files, as their tests share what they make, and takes from the others when it is
# done. `tests/conftest.py` says how many there are.
suite: $(READY)
	$(BIN)/pytest -m "not alone" --numprocesses auto --dist worksteal

# The suite on each Python that the project supports and this machine has, in an environment of its own.
lanes: scripts
	@for version in 3.11 3.12 3.13 3.14; do \
		if ! command -v python$$version >/dev/null; then echo "lane $$version: there is no python$$version"; continue; fi; \
		echo "lane $$version"; \
		$(MAKE) --no-print-directory PYTHON=python$$version VENV=.venv-$$version browser suite || exit; \
	done

# Promises that hold for any input, on all the cases that are promised: hours, where the suite takes some of them.
deep: $(READY)
	DRYCUT_DEEP=1 $(BIN)/pytest -m alone $$(grep -rl --include='test_*.py' 'mark\.alone' tests)
	DRYCUT_DEEP=1 $(BIN)/pytest -m "(alike or deep or deeper or hypothesis) and not alone" --numprocesses auto

# All at once: types take the longest, on one core.
lint: $(READY)
	@$(MAKE) --no-print-directory --jobs types style imports scripts

style: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(READY)
	$(BIN)/mypy

imports: $(READY)
	$(BIN)/lint-imports --no-cache

# Types and style of the scripts of pages, where there is node; pages are made without it.
scripts:
	@if ! command -v npm >/dev/null; then echo "page scripts were not checked: there is no node with npm"; \
	elif ! $(MAKE) --no-print-directory --silent node_modules/.package-lock.json; then \
		echo "page scripts were not checked: npm could not install what checks them"; \
	else npm run --silent lint; fi

# Chromium, for the tests of pages: installed where it is missing and that can be done, or told how to.
browser: $(READY)
	$(BIN)/python tests/tools/chromium.py

bench: $(READY)
	$(BIN)/python tests/tools/bench.py

# Every step of random programs as a plain loop makes it.
steps: $(READY)
	PYTHONPATH=. $(BIN)/python tests/tools/long_steps.py --steps 100000000

# How many faults of each kind are found: the table of docs/check.md.
mutate: $(READY)
	PYTHONPATH=. $(BIN)/python tests/tools/mutation.py

# How many small changes of our own code the tests notice, of a random sample: some minutes for each area.
survivors: $(READY)
	for area in checks iso stepping planner; do PYTHONPATH=. nice $(BIN)/python tests/tools/survivors.py $$area || exit; done

# Promises that hold for any input, on a million inputs of all kinds; and the time of programs bad on purpose.
fuzz: $(READY)
	PYTHONPATH=. $(BIN)/python tests/tools/fuzz.py --inputs 1000000 --hostile

# The same promises on inputs that reach code which none before them reached: ten minutes for each kind of input.
guided: $(READY)
	$(BIN)/pip install --quiet "atheris>=3.0"  # has wheels for Linux and macOS
	PYTHONPATH=. $(BIN)/python tests/tools/guided_fuzz.py

# Renew the golden pictures that no longer fit, after looking at the new ones.
golden: browser
	DRYCUT_RENEW_GOLDEN=1 $(BIN)/pytest $$(grep -rl --include='test_*.py' 'import.* assert_golden' tests)

# Renew docs/findings.md and docs/findings.zh.md from the pages in parser/findings/pages, and the tables of keys in
# docs/scenarios.md and docs/scenarios.zh.md from those in sim/setup; schemas and types of scripts from models,
# and the script of lessons from sim/teach/plain.
pages: $(READY)
	$(BIN)/python -m sim.show.findings.catalogue_document
	$(BIN)/python -m sim.setup.key_tables
	$(BIN)/python tests/tools/door_page.py
	PYTHONPATH=. $(BIN)/python tests/tools/schema_pages.py
	PYTHONPATH=. $(BIN)/python tests/tools/script_types.py
	PYTHONPATH=. $(BIN)/python tests/tools/plain_script.py
	$(BIN)/python tests/tools/licence_page.py

# The extension for VS Code, in out/drycut.vsix; its grammars are tested by the engine that the editor colours with.
vsix: extension
	mkdir -p out
	cd docs/vscode && npm run --silent vsix -- ../../out/drycut.vsix

extension:
	@if ! command -v npm >/dev/null; then echo "the extension was not tested: there is no node with npm"; \
	elif ! $(MAKE) --no-print-directory --silent docs/vscode/node_modules/.package-lock.json; then \
		echo "the extension was not tested: npm could not install what tests it"; \
	else cd docs/vscode && npm test --silent; fi

# drycut in a folder that needs no Python, dist/drycut, for the system that it is packed on; on Windows an installer too.
windows: $(READY)
	$(BIN)/pip install --quiet "pyinstaller>=6.11"
	PYTHONPATH=. $(BIN)/python docs/windows/build.py

# The site of the documents, in out/site: in English and Chinese, links checked, read without a network.
site: $(READY)
	PYTHONPATH=. $(BIN)/python docs/site/build.py

# Renew the locks for every Python the project supports: of all, of all extras without the tests, of the core.
lock: $(READY)
	$(BIN)/pip install --quiet uv
	$(BIN)/uv pip compile --quiet --universal --python-version 3.11 --extra test --extra docs \
		--upgrade --generate-hashes --no-header --output-file requirements-lock.txt pyproject.toml
	for of in core all; do cp requirements-lock.txt requirements-$$of-lock.txt || exit; done  # the same versions
	$(BIN)/uv pip compile --quiet --universal --python-version 3.11 --extra all \
		--generate-hashes --no-header --output-file requirements-all-lock.txt pyproject.toml
	$(BIN)/uv pip compile --quiet --universal --python-version 3.11 \
		--generate-hashes --no-header --output-file requirements-core-lock.txt pyproject.toml
	$(BIN)/python -c "import tomllib; print(*tomllib.load(open('pyproject.toml', 'rb'))['build-system']['requires'])" | \
		$(BIN)/uv pip compile --quiet --universal --python-version 3.11 --constraint requirements-lock.txt \
		--generate-hashes --no-header --output-file requirements-build-lock.txt -

# What a release consists of, in `dist/`: the packages, among them a wheel with the machine code of all loops for this
# system, locks of the core and of all extras, and an SBOM of what they install, with licences.
release: $(READY)
	rm -rf dist
	$(BIN)/python -m hatchling build
	HATCH_BUILD_HOOKS_ENABLE=1 $(BIN)/python -m hatchling build --target wheel
	$(PYTHON) -m venv dist/.tools
	dist/.tools/bin/pip install --quiet --disable-pip-version-check cyclonedx-bom
	cp requirements-core-lock.txt requirements-all-lock.txt dist
	$(PYTHON) -m venv dist/.env
	dist/.env/bin/pip install --quiet --disable-pip-version-check --require-hashes --requirement requirements-all-lock.txt
	dist/.env/bin/pip install --quiet --disable-pip-version-check --no-deps --no-index --find-links dist drycut
	dist/.env/bin/pip uninstall --quiet --yes pip setuptools
	dist/.tools/bin/cyclonedx-py environment --pyproject pyproject.toml --output-reproducible \
		--output-file dist/sbom.cdx.json dist/.env/bin/python
	rm -rf dist/.tools dist/.env
	@ls -l dist

clean:
	rm -rf .venv .venv-* node_modules out dist

docs/vscode/node_modules/.package-lock.json: docs/vscode/package-lock.json
	cd docs/vscode && npm ci --silent --no-audit --no-fund --ignore-scripts
	@touch $@

node_modules/.package-lock.json: package-lock.json .npmrc
	npm ci --silent --no-audit --no-fund
	@touch $@

$(READY): pyproject.toml requirements-lock.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "drycut needs Python 3.11 or newer; this is " + sys.version.split()[0])'
	$(PYTHON) -m venv --clear $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --requirement requirements-lock.txt
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --editable .
	$(BIN)/python -m sim.cli.compile
	@touch $@
