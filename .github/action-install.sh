#!/usr/bin/env bash
# Part of action.yml: installs drycut into an environment of its own and hands its path on as DRYCUT.
set -euo pipefail

# The first Python that is new enough: the one that is asked for alone, or the runner's own.
candidates=(python3 python python3.14 python3.13 python3.12 python3.11)
[ -z "${INPUT_PYTHON:-}" ] || candidates=("$INPUT_PYTHON")
found=""
for python in "${candidates[@]}"; do
  if "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
    found="$python"
    break
  fi
done
if [ -z "$found" ]; then
  echo "::error::drycut needs Python 3.11 or newer, and found none: install one, and name it by the input python"
  exit 2
fi

venv="$RUNNER_TEMP/drycut-venv"
"$found" -m venv --clear "$venv"
bin="$venv/bin"
[ -d "$bin" ] || bin="$venv/Scripts" # Windows
pip() { "$bin/python" -m pip install --quiet --disable-pip-version-check "$@"; }
# The core alone, and what builds it, each package by its hash: another day installs the same.
pip --require-hashes --requirement "$DRYCUT_ACTION/requirements-build-lock.txt"
pip --require-hashes --requirement "$DRYCUT_ACTION/requirements-core-lock.txt"
pip --no-deps --no-build-isolation "$DRYCUT_ACTION"
printf 'DRYCUT=%s\n' "$bin/drycut" >> "$GITHUB_ENV"
