#!/bin/sh
# Two types of one name in one namespace are one type to the linker, which merges the functions that containers of them
# have: bytes get lost, and no compiler tells. Looks at what begins in the first column, outside unnamed namespaces.
cd "$(dirname "$0")/.." || exit 1
twice=$(find engine components systems sample_game -name '*.[ch]pp' -exec awk '
    FNR == 1 { space = ""; is_hidden = 0 }
    /^namespace \{/ { is_hidden = 1 }
    /^\}  \/\/ namespace$/ { is_hidden = 0 }
    /^namespace [a-z:_]+ \{/ { space = (space == "" ? "" : space "::") $2 }
    /^\}  \/\/ namespace [a-z]/ { sub(/(::)?[a-z_]+$/, "", space) }
    !is_hidden && /^(struct|class|enum class|enum) (alignas\([a-zA-Z0-9]+\) )?[A-Z][A-Za-z0-9]*( final)?( : .*)? *\{/ {
        name = $0
        sub(/^(struct|class|enum class|enum) (alignas\([a-zA-Z0-9]+\) )?/, "", name)
        sub(/[^A-Za-z0-9].*/, "", name)
        print space "::" name, FILENAME
    }' {} + | sort -u | awk '{ n[$1]++; files[$1] = files[$1] " " $2 } END { for (t in n) if (n[t] > 1) print t ":" files[t] }')
if [ -n "$twice" ]; then
    echo "More than one definition: rename all but one, or put them into unnamed namespaces."
    echo "$twice"
    exit 1
fi
