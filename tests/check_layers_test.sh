#!/bin/sh
# Shows that scripts/check-layers accepts what is allowed and reports a breach of every rule, with its place.
# usage: check_layers_test.sh CHECK_LAYERS
set -eu
check_layers=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

# A tree of three folders that use every edge of their list.
sound_tree() {
  rm -rf "$folder/src"
  mkdir -p "$folder/src/base" "$folder/src/mesh/parts" "$folder/src/app"
  printf '%s\n' '# comment' '' 'base:' 'mesh: base' 'app: base mesh' > "$folder/src/layers.txt"
  printf '// first line\n' > "$folder/src/base/vec.h"
  printf '// first line\n#include "wheelwright/base/vec.h"\n' > "$folder/src/mesh/mesh.h"
  printf '// first line\n#include "wheelwright/mesh/mesh.h"\n#include <vector>\n' > "$folder/src/mesh/parts/part.cc"
  printf '// first line\n#include "wheelwright/base/vec.h"\n#include "wheelwright/mesh/mesh.h"\n' \
    > "$folder/src/app/main.cc"
}

accepts() {
  "$check_layers" "$folder/src" && return
  echo "refused: $1"
  failures=$((failures + 1))
}

# refuses RULE PLACE...: all of these places are reported, and nothing else is.
refuses() {
  rule=$1
  shift
  if report=$("$check_layers" "$folder/src"); then
    echo "accepted: $rule"
    failures=$((failures + 1))
    return
  fi
  if [ "$(printf '%s\n' "$report" | wc -l)" -ne $# ]; then
    echo "wrong number of complaints: $rule: $report"
    failures=$((failures + 1))
  fi
  for place; do
    case $report in
      *"$place: "*) ;;
      *)
        echo "wrong place: $rule: $report"
        failures=$((failures + 1))
        ;;
    esac
  done
}

sound_tree
accepts 'a sound tree'

# A folder may include itself, from below it too, and anything between angle brackets.
sound_tree
printf '#include "wheelwright/mesh/parts/other.h"\n#include <deal.II/base/quadrature.h>\n' >> "$folder/src/mesh/mesh.h"
accepts 'includes of the own folder and of libraries'

# What looks like an include and is none.
sound_tree
printf '// #include "wheelwright/app/main.h"\nconst char* text = "wheelwright/app/main.h";\n' >> "$folder/src/base/vec.h"
accepts 'a comment and a string'

sound_tree
printf '#include "wheelwright/app/main.h"\n' >> "$folder/src/base/vec.h"
refuses 'an edge that is not listed' base/vec.h:2

sound_tree
printf '  #  include "wheelwright/app/main.h"\n' >> "$folder/src/mesh/parts/part.cc"
refuses 'an edge that is not listed, from a folder below' mesh/parts/part.cc:4

# An edge leads one way only, and is not passed on.
sound_tree
printf '%s\n' 'base:' 'mesh: base' 'app: mesh' > "$folder/src/layers.txt"
refuses 'an edge at second hand' app/main.cc:2

sound_tree
printf '#include "mesh.h"\n' >> "$folder/src/mesh/parts/part.cc"
refuses 'a path from the own folder' mesh/parts/part.cc:4

sound_tree
printf '#include "base/vec.h"\n' >> "$folder/src/mesh/parts/part.cc"
refuses 'a path without the include root' mesh/parts/part.cc:4

sound_tree
printf '#include "wheelwright/version.h"\n' >> "$folder/src/mesh/parts/part.cc"
refuses 'a header in no folder' mesh/parts/part.cc:4

sound_tree
printf '// first line\n' > "$folder/src/mesh/mesh.h"
refuses 'a listed edge without an include' layers.txt:4

sound_tree
mkdir "$folder/src/physics"
printf '// first line\n' > "$folder/src/physics/element.cc"
refuses 'a folder that is not listed' physics/element.cc:1

# A circle of edges has one that leads to a folder below.
sound_tree
printf '%s\n' 'base: app' 'mesh: base' 'app: base mesh' > "$folder/src/layers.txt"
printf '#include "wheelwright/app/main.h"\n' >> "$folder/src/base/vec.h"
refuses 'a circle' layers.txt:1

sound_tree
printf '%s\n' 'base:' 'app: base mesh' 'mesh: base' > "$folder/src/layers.txt"
refuses 'a folder above those that it includes' layers.txt:2

sound_tree
printf '%s\n' 'base:' 'mesh: base' 'app: base mesh' 'gone:' > "$folder/src/layers.txt"
refuses 'a listed folder that does not exist' layers.txt:4

# The same tree, with subfolders of mesh: what parts include of cells must be listed below mesh.
divided_tree() {
  sound_tree
  mkdir "$folder/src/mesh/cells"
  rm "$folder/src/mesh/mesh.h"
  printf '%s\n' 'base:' 'mesh: base' '  cells:' '  parts: cells' 'app: base mesh' > "$folder/src/layers.txt"
  printf '// first line\n#include "wheelwright/base/vec.h"\n' > "$folder/src/mesh/cells/cell.h"
  printf '// first line\n#include "wheelwright/mesh/cells/cell.h"\n' > "$folder/src/mesh/parts/part.cc"
  printf '// first line\n#include "wheelwright/base/vec.h"\n#include "wheelwright/mesh/cells/cell.h"\n' \
    > "$folder/src/app/main.cc"
}
divided_tree
accepts 'a sound tree with subfolders'

divided_tree
printf '#include "wheelwright/mesh/parts/part.h"\n' >> "$folder/src/mesh/cells/cell.h"
refuses 'an edge between subfolders that is not listed' mesh/cells/cell.h:3

divided_tree
printf '// first line\n' > "$folder/src/mesh/parts/part.cc"
refuses 'a listed edge between subfolders without an include' layers.txt:4

divided_tree
mkdir "$folder/src/mesh/faces"
printf '// first line\n' > "$folder/src/mesh/faces/face.cc"
refuses 'a subfolder that is not listed' mesh/faces/face.cc:1

divided_tree
printf '// first line\n' > "$folder/src/mesh/mesh.cc"
refuses 'a file beside the subfolders' mesh/mesh.cc:1

divided_tree
printf '%s\n' 'base:' 'mesh: base' '  parts: cells' '  cells:' 'app: base mesh' > "$folder/src/layers.txt"
refuses 'a subfolder above those that it includes' layers.txt:3

exit "$failures"
