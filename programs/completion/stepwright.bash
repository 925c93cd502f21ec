# Completion of `stepwright` for bash. It has no lists of its own: it offers what the programs say under --help.

# The names of a text of help: of the commands, of the options (both indented by two spaces), or of a command's own commands.
_stepwright_commands() { sed -n 's/^  \([a-z][a-z0-9-]*\) .*/\1/p'; }
_stepwright_options() { sed -n 's/^  \(-[^ ]*\).*/\1/p' | tr ',' '\n' | sed 's/{.*//' | grep '^--'; }
_stepwright_subcommands() { sed -n '/^Subcommands:/,/^$/p' | _stepwright_commands; }

# $1: the program as it was typed.
_stepwright() {
  local program=${1/#\~/$HOME} current=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} help words
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" --help 2>/dev/null | _stepwright_commands) --help --version" -- "$current")
    return
  fi
  help=$("$program" "$command" --help 2>/dev/null) || return
  words=$(_stepwright_subcommands <<<"$help")
  if ((COMP_CWORD > 2)) && grep -qx -- "${COMP_WORDS[2]}" <<<"$words"; then
    help=$("$program" "$command" "${COMP_WORDS[2]}" --help 2>/dev/null) || return
  fi
  if [[ $current == -* ]]; then
    words=$(_stepwright_options <<<"$help")
  elif ((COMP_CWORD > 2)); then
    return  # a file, by `-o default` below
  elif [[ $command == demo || $command == campaign ]]; then
    words=$("$program" demo --list 2>/dev/null)
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}

complete -o default -F _stepwright stepwright
