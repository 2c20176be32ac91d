# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
# Completion of corotet's command line for bash: source this file, or install it as share/bash-completion/completions/corotet.

# Names of all entries, "Section/Entry = ", which program $1 prints.
_corotet_entries()
{
  "$1" --print-parameters prm 2>/dev/null | awk '
    $1 == "subsection" { sub(/^ *subsection /, ""); section[++depth] = $0 }
    $1 == "end" { depth-- }
    $1 == "set" {
      sub(/^ *set /, ""); sub(/ *=.*/, "")
      path = ""
      for (i = 1; i <= depth; ++i) path = path section[i] "/"
      print path $0 " = "
    }'
}

_corotet()
{
  local program=$1 word=$2 previous=$3 entry
  COMPREPLY=()
  case $previous in
    --set)
      compopt -o filenames -o nospace 2>/dev/null
      word=${word#[\"\']}
      while IFS= read -r entry; do
        [[ $entry == "$word"* ]] && COMPREPLY+=("$entry")
      done < <(_corotet_entries "$program")
      return ;;
    --output)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$word")
      return ;;
    --print-parameters)
      mapfile -t COMPREPLY < <(compgen -W "prm json markdown schema" -- "$word")
      return ;;
    --degree)
      mapfile -t COMPREPLY < <(compgen -W "1 2 3" -- "$word")
      return ;;
    --size | --feature-angle)
      return ;;
  esac
  local options="--help --version --set --output --validate --print-parameters --restart --report --list --quiet" commands=mesh
  if [[ ${COMP_WORDS[1]} == mesh && $COMP_CWORD -gt 1 ]]; then
    options="--help --size --degree --feature-angle --out" commands=
  fi
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
    return
  fi
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$word"; compgen -f -- "$word")
}

complete -F _corotet corotet
