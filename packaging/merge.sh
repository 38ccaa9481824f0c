#!/bin/sh
# merge.sh IN.a OUT.a PREFIX: makes of a Rust static library one of a single object, in
# which only symbols that begin with PREFIX are global. Rust's own has thousands, the
# standard library's among them, which would collide with those of another Rust library.
set -eu
in=$1
out=$2
prefix=$3
ld=${LD:-ld}
objcopy=${OBJCOPY:-objcopy}
nm=${NM:-nm}
ar=${AR:-ar}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# nm says of the members that have no symbols that they have none.
"$nm" -g --defined-only "$in" 2>/dev/null | sed -n "s/^[0-9a-f]* [A-Z] \($prefix[A-Za-z0-9_]*\)\$/\1/p" |
    sort -u >"$work/symbols"
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

undefined() { # BINDING FILE
    "$nm" -g --undefined-only "$2" 2>/dev/null | sed -n "s/^ *$1 //p" | sort -u
}
undefined w "$in" >"$work/weak"
undefined U "$in" | comm -23 "$work/weak" - >"$work/only-weak"
undefined U "$out" | comm -12 "$work/only-weak" - >"$work/strengthened"
groups=$("${READELF:-readelf}" -WS "$out" | grep -c ' GROUP ' || true)
if [ "$groups" != 0 ] || [ -s "$work/strengthened" ]; then
    rm -f "$out"
    echo "$ld kept $groups section groups, GNU ld 2.29 or newer keeps none;" \
        "or made weak symbols strong: $(tr '\n' ' ' <"$work/strengthened")" >&2
    exit 1
fi
