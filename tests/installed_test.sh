#!/usr/bin/env bash
# Installs the build below a temporary root (DESTDIR), moves the installed tree, and checks there, with nothing else of
# the build or its sources:
# - each-header: that each header compiles on its own.
# - all: that the headers include no others than those of the standard library and compile together; that a program
#   outside of the project, examples/optimize_a_wheel, builds by CMake package and by pkg-config, improves a wheel at
#   constant volume and finds what the installed program finds; that a material law of its own, examples/own_material,
#   gives what the built-in law gives; that an own command and an own observer, examples/own_command, take part in a run;
#   that an own key of [load], examples/own_load_key, gives what the built-in key gives, in load cases and after a stop;
#   that the library shows no names but its own.
# usage: installed_test.sh all|each-header BUILD_FOLDER COMPILER [FLAG...]
set -euo pipefail
subject=$1 build=$2 compiler=$3 flags=("${@:4}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() {
  echo "$*" >&2
  exit 1
}

DESTDIR=$folder/root cmake --install "$build" >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
prefix=$folder/elsewhere
program=$(find "$folder/root" -path '*/bin/wheelwright')
mv "$(dirname "$(dirname "$program")")" "$prefix"
library=$(find "$prefix" -name libwheelwright.so)
documents=$prefix/share/doc/wheelwright

export -n LD_LIBRARY_PATH
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1

# compiles HEADER...: as the only includes of a file.
compiles() {
  printf '#include "%s"\n' "$@" >"$folder/headers.cc"
  "$compiler" "${flags[@]}" -std=c++20 -fsyntax-only -Wall -Wextra -Wno-unused-parameter -Werror -I"$prefix/include" \
    "$folder/headers.cc"
}

# Prints includes that are neither of the standard library, whose names have no dot, nor installed themselves.
foreign_includes() {
  local header
  grep -rh '^ *# *include' "$prefix/include" | grep -v '<[a-z_]*>' | sort -u | while IFS='"' read -r _ header _; do
    [[ -f $prefix/include/$header ]] || echo "${header:-in angle brackets, with a dot}"
  done
}

foreign_names() {
  nm --dynamic --defined-only --extern-only "$library" | awk '$3 !~ /^_Z(N|NK|T.*N)11wheelwright/ { print $3 }'
}

# accepted_shapes HISTORY: number, objective and volume of every accepted shape.
accepted_shapes() {
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; ++i) { word = $i; sub(/ .*/, "", word); column[word] = i } next }
    $column["accepted"] { print $column["iteration"], $column["objective"], $column["volume"] }' "$1"
}

# check_improvement SHAPES: the objective falls and the volume stays.
check_improvement() {
  awk '
    NR == 1 { first = $2; volume = $3 }
    { last = $2; change = $3 / volume - 1; if (change < 0) change = -change; if (change > 1e-6) exit wrong = 1 }
    END { exit wrong || NR < 6 || !(last < 0.95 * first) }' "$1"
}

# check_agreement SHAPES SHAPES: as many shapes, with the same numbers up to 1e-12.
check_agreement() {
  paste -d ' ' "$1" "$2" | awk '
    function differ(a, b) { d = a / b - 1; return d < -1e-9 || d > 1e-9 }
    NF != 6 || $1 != $4 || differ($2, $5) || differ($3, $6) { print; wrong = 1 }
    END { exit wrong || NR == 0 }'
}

mapfile -t headers < <(cd "$prefix/include" && find . -name '*.h' | sed 's,^./,,' | sort)
if [[ $subject == each-header ]]; then
  for header in "${headers[@]}"; do compiles "$header"; done
  exit
fi

for file in LICENSE README.md CHANGELOG.md docs/method.md cases/holes16.toml; do
  [[ -s $documents/$file ]] || fail "not installed: $file"
done
[[ $("$prefix/bin/wheelwright" docs --print) == "$documents"/* ]] || fail "the installed program does not find its documents"

[[ -z $(foreign_includes) ]] || fail "headers include what is not public:" "$(foreign_includes)"
compiles "${headers[@]}"
[[ -z $(foreign_names) ]] || fail "the library shows names of others:" "$(foreign_names)"

sed 's/^iterations = .*/iterations = 5/' "$documents/cases/holes16.toml" >"$folder/case.toml"
"$prefix/bin/wheelwright" run "$folder/case.toml" --output "$folder/run" >"$folder/log" 2>&1 ||
  fail "$(cat "$folder/log")"
accepted_shapes "$folder/run/history.csv" >"$folder/shapes"

# build_example NAME: copies and builds it in $folder/NAME.
build_example() {
  local generator
  generator=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$build/CMakeCache.txt")
  cp -r "$documents/examples/$1" "$folder/$1"
  {
    cmake -G "$generator" -S "$folder/$1" -B "$folder/$1/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release \
      -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="${flags[*]}" &&
      cmake --build "$folder/$1/build"
  } >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
}

build_example own_material
# An own law is in elements without projection.
sed 's/^\[grid\]$/[grid]\ndilatation = "pointwise"/' "$folder/case.toml" >"$folder/pointwise.toml"
"$folder/own_material/build/own_material" "$folder/pointwise.toml" >"$folder/materials"
# check_materials: the own law agrees with the built-in one, and the warm wheel stores more energy than the cold one. Both are
# the same up to rounding, and contact is solved until the ground's force is that of the load up to 1e-11.
check_materials() {
  awk '
    function differ(a, b) { d = a / b - 1; return d < -1e-9 || d > 1e-9 }
    NF != 7 || differ($2, $5) || differ($3, $6) || differ($4, $7) { exit wrong = 1 }
    NR == 2 && !($2 > 2 * cold) { exit wrong = 1 }
    { cold = $2 }
    END { exit wrong || NR != 2 }' "$1"
}
check_materials "$folder/materials" || fail "an own material law gives something else: $(cat "$folder/materials")"

build_example own_command
# steer RUN LOG: runs or resumes it with the commands of a log; prints shapes and commands.
steer() {
  "$folder/own_command/build/own_command" "$folder/case.toml" "$folder/$1" "$2"
}
# logged TRIALS COMMAND: a line of a command log.
logged() {
  printf '{"trials":%s,"waits":0,"command":%s}\n' "$1" "$2"
}
logged 2 '{"do":"scale_load","factor":-1}' >"$folder/log_to_steer"
logged 2 '{"do":"scale_load","factor":1.25}' >>"$folder/log_to_steer"
steer steered "$folder/log_to_steer" >"$folder/steered.txt"
grep -q '^refused scale_load: .' "$folder/steered.txt" || fail "an own command was not refused: $(cat "$folder/steered.txt")"
grep -q '^executed scale_load' "$folder/steered.txt" || fail "an own command was not executed: $(cat "$folder/steered.txt")"
[[ $(grep -o '"factor":[^}]*' "$folder/steered/commands.jsonl") == '"factor":1.25' ]] ||
  fail "the log of an own command: $(cat "$folder/steered/commands.jsonl")"

steer replayed "$folder/steered/commands.jsonl" >"$folder/replayed.txt"
cmp <(grep ^shape "$folder/steered.txt") <(grep ^shape "$folder/replayed.txt") || fail "a replay of an own command differs"

{ cat "$folder/steered/commands.jsonl" && logged 5 '{"do":"stop"}'; } >"$folder/log_to_stop"
steer stopped "$folder/log_to_stop" >"$folder/stopped.txt"
steer stopped /dev/null >>"$folder/stopped.txt"
cmp <(grep ^shape "$folder/steered.txt") <(grep ^shape "$folder/stopped.txt") ||
  fail "a run with an own command is resumed with other shapes: $(cat "$folder/stopped.txt")"

build_example optimize_a_wheel
loaded=$(LD_TRACE_LOADED_OBJECTS=1 "$folder/optimize_a_wheel/build/optimize_a_wheel")
[[ $loaded == *"$prefix"*libwheelwright* ]] || fail "another library is loaded: $loaded"
"$folder/optimize_a_wheel/build/optimize_a_wheel" "$folder/case.toml" >"$folder/shapes_of_example"
check_improvement "$folder/shapes_of_example" || fail "not improved: $(cat "$folder/shapes_of_example")"
check_agreement "$folder/shapes_of_example" "$folder/shapes" || fail "not what the installed program finds"

# A program that adds a quantity of its own, in the objective and in a bound of the case.
printf '\n[[objective.term]]\nquantity = "bulk_energy"\n[[constraint]]\nquantity = "bulk_energy"\nat_most = 1e3\n' |
  cat <(sed 's/^method = "descent"/method = "sequential_quadratic"/' "$folder/case.toml") - >"$folder/own.toml"
build_example own_quantity
"$folder/own_quantity/build/own_quantity" "$folder/own.toml" "$folder/own_run"
for file in history.csv report.html; do
  grep -q '\<bulk_energy \[J/m\].*bounded bulk_energy \[J/m\]' "$folder/own_run/$file" ||
    fail "no columns of the own quantity in $file"
done

# A program with a key of its own in [load], the slope of a road, which acts as a horizontal force would.
build_example own_load_key
# sloping_case ROAD HILL: two load cases with these keys.
sloping_case() {
  sed 's/^gamma_0 = 1$/gamma_0 = 1\nfriction = 0.9/' "$folder/case.toml"
  printf '\n[[load.case]]\nname = "road"\n%s\n[[load.case]]\nname = "hill"\n%s\n' "$1" "$2"
}
sloping_case 'slope = 2' 'slope = -5' >"$folder/sloping.toml"
# -m g tan(slope) of 300 kg
sloping_case 'horizontal_force = -102.77182461421357' 'horizontal_force = 257.47913675679433' >"$folder/pulled.toml"
"$folder/own_load_key/build/own_load_key" "$folder/sloping.toml" "$folder/sloping"
"$prefix/bin/wheelwright" run "$folder/pulled.toml" --output "$folder/pulled" >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
for run in sloping pulled; do accepted_shapes "$folder/$run/history.csv" >"$folder/$run.txt"; done
check_agreement "$folder/sloping.txt" "$folder/pulled.txt" || fail "an own key of [load] gives something else"
grep -q '^slope = -5$' "$folder/sloping/case.toml" || fail "no own key in $(cat "$folder/sloping/case.toml")"

export PKG_CONFIG_PATH=${library%/*}/pkgconfig
read -ra package < <(pkg-config --cflags --libs wheelwright)
"$compiler" "${flags[@]}" -std=c++20 "$folder/optimize_a_wheel/main.cc" -o "$folder/by_pkg_config" "${package[@]}"
LD_LIBRARY_PATH=${library%/*} "$folder/by_pkg_config" "$folder/case.toml" >"$folder/shapes_by_pkg_config"
cmp "$folder/shapes_by_pkg_config" "$folder/shapes_of_example"
