#compdef tyndall
# Completion of tyndall for zsh; made by "tyndall help zsh".
_tyndall_words() {
  local -a scenes
  scenes=(${(f)"$(tyndall scenes 2>/dev/null | cut -d ' ' -f 1)"})
  _alternative 'scenes:built-in scene:compadd -a scenes' 'files:file:_files'
}
_tyndall() {
  if (( CURRENT == 2 )); then
    local -a commands
    commands=(
{{commands}}    )
    _describe command commands
    _tyndall_words
    return
  fi
  shift words
  (( CURRENT-- ))
  case $words[1] in
{{options}}    *) _tyndall_words ;;
  esac
}
_tyndall "$@"
