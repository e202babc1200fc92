# Completion of wheelwright for bash: commands, their options, presets, keys of a case, formats, quantities, and files. The
# installed program itself tells which there are.
# shellcheck shell=bash

# The second line of each entry of a list in --help is indented too, but more.
_wheelwright_commands() { wheelwright --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\+\) .*/\1/p'; }
_wheelwright_options() { wheelwright ${1:+"$1"} --help 2>/dev/null | grep -o -- '--[a-z-]\+' | sort -u; }
_wheelwright_formats() { wheelwright export --help 2>/dev/null | sed -n 's/.*Any of \([a-z0-9, ]*\);.*/\1/p' | tr -d ,; }
_wheelwright_presets() { wheelwright init --list 2>/dev/null | sed -n 's/^\([a-z0-9-]\+\) .*/\1/p'; }
_wheelwright_quantities() { wheelwright sweep --help 2>/dev/null | sed -n '/^  --for /s/.*known: *//p' | tr -d ,; }
# The keys that hold a number and stand once in a case, as `sweep` takes them.
_wheelwright_keys() {
  wheelwright reference 2>/dev/null | awk -F ' *[|] *' '
    /^## / { section = match($0, /^## \[[a-z_.]+\]/) ? substr($0, 5, RLENGTH - 5) "." : "" }
    section && $4 ~ /</ { gsub(/`/, "", $2); print section $2 "=" }'
}

# Completes the last item of a list with commas.
_wheelwright_list() {
  local word=$1 list=
  [[ $word == *,* ]] && list=${word%,*},
  mapfile -t COMPREPLY < <(compgen -P "$list" -W "$2" -- "${word##*,}")
  compopt -o nospace
}

_wheelwright() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=
  ((COMP_CWORD > 1)) && command=${COMP_WORDS[1]}
  if [[ $command == export && $before == --format ]]; then
    _wheelwright_list "$word" "$(_wheelwright_formats)"
  elif [[ $before == --for ]]; then
    _wheelwright_list "$word" "$(_wheelwright_quantities)"
  elif [[ $command == init && $before == --preset ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_wheelwright_presets)" -- "$word")
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_wheelwright_options "$command")" -- "$word")
  elif [[ -z $command ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_wheelwright_commands)" -- "$word")
  elif [[ $command == sweep && $COMP_CWORD -gt 2 ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_wheelwright_keys)" -- "$word")
    compopt -o nospace
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
    compopt -o filenames
  fi
}
complete -F _wheelwright wheelwright
