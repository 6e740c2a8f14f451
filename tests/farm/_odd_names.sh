# shellcheck shell=bash disable=SC2034,SC2016
# Sourced: names of files that scripts stumble over, without the ending.
odd_names=('two words' ' in front and behind ' $'line\nfeed' "it's \"quoted\"" '-dash' 'per%cent %a %j %%' 'dol$HOME$(id)`id`'
  'back\slash\n' 'Grüße, 世界' 'br{}{1}{= die =}' 'a:b,c' '*?[x]' '~' '~root' 'and&;|touch pwned;#' $'esc\x1b[31m' $'bytes\xff' '!!')
