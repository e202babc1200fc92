#!/usr/bin/env bash
# Tests the completion for bash and the man page against what the program tells. usage: completion_test.sh PROGRAM_FOLDER, from
# the repository's top folder.
set -euo pipefail
PATH=$1:$PATH
. packaging/wheelwright.bash
compopt() { :; }  # works only while the shell completes

failures=0
# offers EXPECTED -- WORDS...: what is offered for the last word, in one line
offers() {
  local expected=$1
  shift 2
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _wheelwright
  [[ ${COMPREPLY[*]} == "$expected" ]] && return
  echo "offered for '$*': ${COMPREPLY[*]}; expected: $expected"
  failures=$((failures + 1))
}

offers "watch" -- wheelwright wa
offers "docs" -- wheelwright doc
offers "--print" -- wheelwright docs --p
offers "resume report reference" -- wheelwright re
offers "paper16 paper16-3d" -- wheelwright init --preset paper16
offers "load.mass=" -- wheelwright sweep case.toml load.mas
offers "wheel.inner_radius=" -- wheelwright sweep case.toml load.mass=1 wheel.inn
offers "" -- wheelwright sweep case.toml holes.ring
offers "" -- wheelwright sweep case.toml material.pl
offers "dxf,step" -- wheelwright export runs/a --format dxf,ste
offers "run_out,peak_stress" -- wheelwright explore a.toml --for run_out,peak_s
offers "--no-browser" -- wheelwright watch --no
offers "packaging" -- wheelwright check packag

commands=$(_wheelwright_commands)
keys=$(_wheelwright_keys)
[[ $(wc -w <<<"$commands") -ge 13 && $(wc -w <<<"$keys") -ge 40 ]] || failures=$((failures + 1))
for command in $commands; do
  grep -q "^\.BI\? $command\b" packaging/wheelwright.1 || { echo "the man page lacks $command"; failures=$((failures + 1)); }
done
((failures == 0))
