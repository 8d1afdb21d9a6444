#!/usr/bin/env bash
# Part of action.yml: installs drycut into an environment of its own and hands its path on as DRYCUT.
set -euo pipefail

venv="$RUNNER_TEMP/drycut-venv"
"$DRYCUT_PYTHON" -m venv --clear "$venv"
bin="$venv/bin"
[ -d "$bin" ] || bin="$venv/Scripts" # Windows
pip() { "$bin/python" -m pip install --quiet --disable-pip-version-check "$@"; }
# The core alone, each package by its hash: a check needs no more, and another day installs the same.
pip --require-hashes --requirement "$DRYCUT_ACTION/requirements-core-lock.txt"
pip --no-deps "$DRYCUT_ACTION"
printf 'DRYCUT=%s\n' "$bin/drycut" >> "$GITHUB_ENV"
