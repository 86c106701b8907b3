# Prints what zsh completes: zsh -f capture_completion.zsh FOLDER "LINE". FOLDER has the completion functions.
# An interactive zsh in a terminal of its own gets the line and a tab; its compadd prints instead of adding.
zmodload zsh/zpty
zpty shell zsh -f -i

start=$(mktemp)
cat > $start <<SETUP
PROMPT=
fpath=($1 \$fpath)
autoload -U compinit
compinit -u -D
bindkey '^I' complete-word
zstyle ':completion:*' insert-tab false
mark () { print -r - '#mark' }
compprefuncs=(mark)
comppostfuncs=(mark exit)
SETUP
cat >> $start <<'SETUP'
compadd () {
    # Calls that only fill arrays are the completion system's own.
    if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then
        builtin compadd "$@"
        return
    fi
    local -a hits
    builtin compadd -A hits "$@"
    local hit
    for hit in $hits; print -r - "#hit $hit"
}
print -r - '#ready'
SETUP
zpty -w shell "source $start"
while zpty -r shell line; do [[ $line == *'#ready'* ]] && break; done

zpty -w -n shell "$2"$'\t'
marks=0
while (( marks < 2 )) && zpty -r shell line; do
    line=${line%$'\r\n'}
    [[ $line == *'#mark' ]] && (( ++marks ))
    [[ $line == *'#hit '* ]] && print -r - ${line#*'#hit '}
done
rm -f $start
