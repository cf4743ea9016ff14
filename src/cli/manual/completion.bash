# Written by `vantage explain --completion FILE`.
_vantage_parts() {
  case "$1" in
@parts@
  esac
}
_vantage_flags() {
  case "$1" in
@flags@
  esac
}
_vantage_words() {
  case "$1" in
@words@
  esac
}
_vantage_values() {
  case "$1" in
@values@
  esac
}
_vantage_keys="@keys@"
_vantage() {
  local word cur=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} path="" i found=""
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    [[ " $(_vantage_parts "$path") " == *" $word "* ]] || break
    path=${path:+$path }$word
  done
  if [[ $cur == = ]]; then
    previous="=" cur="" word=${COMP_WORDS[COMP_CWORD - 1]}
  elif [[ $previous == = ]]; then
    word=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  if [[ $previous == = ]]; then
    found=$(_vantage_values "$word")
  elif [[ $cur == -* ]]; then
    found=$(_vantage_flags "$path")
  elif [[ $previous == --set ]]; then
    COMPREPLY=($(compgen -W "$_vantage_keys" -S = -- "$cur"))
    compopt -o nospace 2>/dev/null
    return
  elif [[ $previous == -* ]]; then
    found=$(_vantage_words "$path $previous")
    [[ $found ]] || found=$(_vantage_words " $previous")
  else
    found="$(_vantage_parts "$path") $(_vantage_words "$path ")"
  fi
  COMPREPLY=($(compgen -W "$found" -- "$cur"))
}
complete -o bashdefault -o default -F _vantage vantage
