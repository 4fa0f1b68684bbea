#!/bin/sh
# No function of the libraries given takes more than 6 KiB of stack at once: 64 KiB are enough for a step, because no
# frame on the way has a large part of them. Who needs more takes it from State::scratch or from the frame's arena.
# Frames are read from what the compiler made of the prologues.
most=6144
fewest_functions=300  # of a library; fewer means that nothing was read
command -v objdump >/dev/null || { echo "objdump is missing: install binutils."; exit 1; }
for library in "$@"; do
    functions=$(objdump -d --no-show-raw-insn "$library" | grep -c '^[0-9a-f]* <.*>:$')
    if [ "$functions" -lt $fewest_functions ]; then
        echo "$library: objdump shows $functions functions, expected at least $fewest_functions."
        exit 1
    fi
done
found=$(for library in "$@"; do
    objdump -d --no-show-raw-insn "$library" | awk '
        /^[0-9a-f]+ <.*>:$/ { name = substr($2, 2, length($2) - 3); next }
        /[[:space:]]sub +\$0x[0-9a-f]+,%rsp/ {
            match($0, /\$0x[0-9a-f]+/); print substr($0, RSTART + 3, RLENGTH - 3), name
        }
        /[[:space:]]lea +-0x[0-9a-f]+\(%rsp\),%r(11|sp)/ {
            match($0, /-0x[0-9a-f]+/); print substr($0, RSTART + 3, RLENGTH - 3), name
        }'
done | while read -r hex name; do
    # Eight digits and more are negative: memory is given back.
    [ "${#hex}" -ge 4 ] && [ "${#hex}" -lt 8 ] && [ $((0x$hex)) -gt $most ] && echo "$((0x$hex)) $name"
done | sort -rn | c++filt)
if [ -n "$found" ]; then
    echo "Frames of more than $most bytes:"
    echo "$found"
    exit 1
fi
