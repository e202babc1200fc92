#!/bin/sh
# Shows that scripts/check-layers accepts what is allowed and reports a breach of every rule.
# usage: check_layers_test.sh CHECK_LAYERS
set -eu
check_layers=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

# with FILE LINE: a source tree with nothing but this line.
with() {
  rm -rf "$folder/src"
  mkdir -p "$folder/src/$(dirname "$1")"
  printf '// first line\n%s\n' "$2" > "$folder/src/$1"
}

accepts() {
  with "$1" "$2"
  "$check_layers" "$folder/src" && return
  echo "refused: $1: $2"
  failures=$((failures + 1))
}

refuses() {
  with "$1" "$2"
  if report=$("$check_layers" "$folder/src"); then
    echo "accepted: $1: $2"
    failures=$((failures + 1))
  elif [ "${report#"src/$1:2:"}" = "$report" ]; then
    echo "wrong place: $report"
    failures=$((failures + 1))
  fi
}

accepts optimize/optimizer.cc '#include "evolution/evolver.h"'
accepts case/case.cc '#include "base/vec.h"'
accepts case/case.h '#include "elasticity/material.h"'
accepts app/commands/run.cc '#include "optimize/optimizer.h"'

refuses geometry/level_set.h '#include "cut/cut_domain.h"'
refuses geometry/level_set.h '  #  include "cut/cut_domain.h"'
refuses case/case.cc '#include "linalg/dense.h"'
refuses case/case.cc '#include "elasticity/element.h"'
refuses evolution/velocity.cc '#include "elasticity/element.h"'
refuses evolution/velocity.cc '#include "cyclic/harmonics.h"'
refuses evolution/velocity.cc '#include "contact/tread.h"'
refuses elasticity/element.cc '#include "element.h"'
refuses output/svg.cc '#include "case/case.h"'

with physics/element.cc ''
if "$check_layers" "$folder/src" > "$folder/report"; then
  echo "accepted: a folder that is no layer"
  failures=$((failures + 1))
fi

exit "$failures"
