# Prints what bash completes: bash --norc capture_completion.bash SCRIPT "LINE". SCRIPT has the completion function.
source /usr/share/bash-completion/bash_completion
source "$1"
# Only readline itself has options of a completion to set.
compopt() { :; }

# As readline hands a line over: '=' is a word of its own.
COMP_LINE=$2
COMP_POINT=${#2}
read -ra COMP_WORDS <<< "${2//=/ = }"
[[ $2 == *[\ =] ]] && COMP_WORDS+=('')
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_trapwright
printf '%s\n' "${COMPREPLY[@]}"
