#!/bin/sh
# merge.sh IN.a OUT.a PREFIX: makes of a Rust static library one of a single object, in
# which only symbols that begin with PREFIX are global. Rust's own has thousands, the
# standard library's among them, which would collide with those of another Rust library.
set -eu
export LC_ALL=C
in=$1
out=$2
prefix=$3
ld=${LD:-ld}
objcopy=${OBJCOPY:-objcopy}
readelf=${READELF:-readelf}
ar=${AR:-ar}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Read from the ELF tables: nm may have a plug-in that reads bitcode beside them instead.
# BIND is GLOBAL or WEAK; WHERE is UND for what is undefined.
names() { # BIND WHERE FILE
    "$readelf" -Ws "$3" | awk -v bind="$1" -v undefined="$2" \
        '$5 == bind && ($7 == "UND") == (undefined == "UND") { print $8 }' | sort -u
}

names GLOBAL here "$in" | sed -n "/^$prefix[A-Za-z0-9_]*\$/p" >"$work/symbols"
if [ ! -s "$work/symbols" ]; then
    echo "$in defines no symbol that begins with $prefix" >&2
    exit 1
fi

# --force-group-allocation: `DW.ref.rust_eh_personality` comes in a COMDAT group. Were it
# kept as one, the linker would drop it from the second library of a program by its name,
# although its symbol is local by then, and unwinding would jump into nowhere.
# --gc-sections with the roots named: what no function needs goes, with its unwind tables;
# sections stay apart, so that a program's own --gc-sections still works.
sed 's/^/-u /' "$work/symbols" >"$work/roots"
"$ld" -r --force-group-allocation --gc-sections "@$work/roots" -o "$work/all.o" "$in"

# --strip-unneeded: of symbols that only dropped code used, weak ones among them, ld leaves
# strong undefined ones behind, which another library's weak reference would take up.
# .llvmbc, .llvmcmd: bitcode that rustc puts beside the code; joined by the linker it is no
# bitcode any more, and LLVM's plug-in for binutils aborts on it.
"$objcopy" --keep-global-symbols="$work/symbols" --strip-unneeded \
    --remove-section .llvmbc --remove-section .llvmcmd \
    "$work/all.o" "$work/${prefix%_}.o"
rm -f "$out"
"$ar" rcsD "$out" "$work/${prefix%_}.o"

# Weak in the archive and nowhere strong, but strong now.
names WEAK UND "$in" >"$work/weak"
names GLOBAL UND "$in" | comm -23 "$work/weak" - >"$work/only-weak"
names GLOBAL UND "$out" | comm -12 "$work/only-weak" - >"$work/strengthened"
groups=$("$readelf" -WS "$out" | grep -c ' GROUP ' || true)
if [ "$groups" != 0 ] || [ -s "$work/strengthened" ]; then
    rm -f "$out"
    echo "$ld kept $groups section groups, GNU ld 2.29 or newer keeps none;" \
        "or made weak symbols strong: $(tr '\n' ' ' <"$work/strengthened")" >&2
    exit 1
fi
