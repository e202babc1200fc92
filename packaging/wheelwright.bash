# Completion of wheelwright for bash: commands, their options, formats, and files. Commands, options and formats are
# those that the installed program itself tells.
# shellcheck shell=bash

# The second line of each entry of a list in --help is indented too, but more.
_wheelwright_commands() { wheelwright --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\+\) .*/\1/p'; }
_wheelwright_options() { wheelwright ${1:+"$1"} --help 2>/dev/null | grep -o -- '--[a-z-]\+' | sort -u; }
_wheelwright_formats() { wheelwright export --help 2>/dev/null | sed -n 's/.*Any of \([a-z0-9, ]*\);.*/\1/p' | tr -d ,; }

_wheelwright() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=
  ((COMP_CWORD > 1)) && command=${COMP_WORDS[1]}
  if [[ $command == export && $before == --format ]]; then
    local list=
    [[ $word == *,* ]] && list=${word%,*},
    mapfile -t COMPREPLY < <(compgen -P "$list" -W "$(_wheelwright_formats)" -- "${word##*,}")
    compopt -o nospace
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_wheelwright_options "$command")" -- "$word")
  elif [[ -z $command ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_wheelwright_commands)" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
    compopt -o filenames
  fi
}
complete -F _wheelwright wheelwright
