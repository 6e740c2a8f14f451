# Completion of tyndall for bash; made by "tyndall help bash".
_tyndall_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$1")
}
_tyndall() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]} words=''
  COMPREPLY=()
  if [ "$word" = = ]; then word=''; elif [ "$before" = = ]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi
  case "$command $before" in
{{values}}  esac
  local commands='{{commands}}'
  if [ -n "$words" ]; then :
  elif [[ $word == -* ]]; then
    case $command in
{{options}}      *) words='--help --version' ;;
    esac
  else
    words=$(tyndall scenes 2>/dev/null | cut -d ' ' -f 1)
    [ "$COMP_CWORD" -gt 1 ] || words="$words $commands"
    _tyndall_files "$word"
  fi
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -F _tyndall tyndall
