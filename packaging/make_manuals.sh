#!/usr/bin/env bash
# Writes the manual pages of both programs and of every command with help2man, from what --help prints:
# make_manuals.sh FOLDER VERSION TRAPWRIGHT [STUDIO]. The build does this; see packaging/CMakeLists.txt.
set -euo pipefail

folder=$1
version=$2
program=$3
studio=${4:-}

# Without a display the studio still tells its options.
export QT_QPA_PLATFORM=offscreen LC_ALL=C.UTF-8

# page NAME "WHAT IT IS" [HELP2MAN OPTION...] COMMAND
page() {
    local name=$1 subject=$2
    shift 2
    help2man --no-info --section=1 --source="Trapwright $version" --manual="Trapwright" \
        --version-string="$version" --name="$subject" "$@" |
        # In its heading and its name a page is called as it is looked up: trapwright-part. Examples keep their lines.
        sed -e '/^\.SS "Example:"$/,/^\.SH/s/^trapwright /.br\n&/' -e 's/^\.SS "Example:"$/.SH EXAMPLE/' \
            -e "s/^\.TH [^ ]* /.TH ${name^^} /" -e "s/^${name/-/ } \\\\- /$name \\\\- /" |
        gzip -9n > "$folder/$name.1.gz"
}

see=$(mktemp)
trap 'rm -f "$see"' EXIT
mkdir -p "$folder"
rm -f "$folder"/*.1.gz

mapfile -t commands < <("$program" --help | sed -n '/^Commands:$/,/^$/s/^  \([a-z][a-z-]*\) .*/\1/p')
{
    printf '[see also]\n.nh\n'
    printf '.BR trapwright-%s (1),\n' "${commands[@]}"
    echo '.BR trapwright-studio (1)'
} > "$see"
page trapwright "design tracks for vibratory part feeders" --include="$see" "$program"

printf '[see also]\n.BR trapwright (1)\n' > "$see"
for command in "${commands[@]}"; do
    # Whole, then its first line: who stops reading (head) ends a program that has more to say.
    subject=$("$program" "$command" --help)
    subject=${subject%%$'\n'*}
    page "trapwright-$command" "${subject%%[.:]*}" --include="$see" "$program $command"
done
if [[ -n $studio ]]; then
    page trapwright-studio "design tracks for vibratory part feeders, in a window" --include="$see" "$studio"
fi
