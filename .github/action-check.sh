#!/usr/bin/env bash
# Part of action.yml: runs DRYCUT with the inputs of the environment, and hands on where the SARIF file is.
set -euo pipefail

# A value is tied to its option by =, so one that begins with a dash stays a value.
options=(--lang="$INPUT_LANG")
add() { [ -z "$2" ] || options+=("$1=$2"); }
add --fail-on "$INPUT_FAIL_ON"
add --machine "$INPUT_MACHINE"
add --wire-diameter "$INPUT_WIRE_DIAMETER"
add --gap "$INPUT_GAP"
add --select "$INPUT_SELECT"
add --ignore "$INPUT_IGNORE"

files=()
while IFS= read -r file; do
  file="${file%$'\r'}"
  [ -z "$file" ] || files+=("$file")
done <<< "$INPUT_FILES"
[ "${#files[@]}" -gt 0 ] || files=(.)

outputs=(--format="$INPUT_FORMAT")
[ -z "$INPUT_SARIF_FILE" ] || outputs+=(--format="sarif=$INPUT_SARIF_FILE")

check() { "$DRYCUT" check "${outputs[@]}" "${options[@]}" -- "${files[@]}"; }

# Nothing in a program or a name can guess this word.
word="drycut-$(od -An -N16 -tx1 /dev/urandom | tr -d ' \n')"
started="$(mktemp)"

status=0
if [ "$INPUT_FORMAT" = github ]; then
  check || status=$?
else
  # The other formats show lines of programs, which must not be commands to the runner.
  echo "::stop-commands::$word"
  check || status=$?
  echo "::$word::"
fi

# Bad use writes no file; one that was there before is not of this run.
if [ -f "$INPUT_SARIF_FILE" ] && ! [ "$INPUT_SARIF_FILE" -ot "$started" ]; then
  printf 'sarif-file<<%s\n%s\n%s\n' "$word" "$INPUT_SARIF_FILE" "$word" >> "$GITHUB_OUTPUT"
fi
rm -f "$started"
exit "$status"
