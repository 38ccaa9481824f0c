#!/bin/sh
# build.sh OUT PROFILE: builds both libraries into OUT and, last, OUT/facts, which is
# all that installing must know, so that `make install` runs no cargo.
set -eu
export LC_ALL=C
cd "$(dirname "$0")/.."
out=$1
profile=$2
# A command, such as `cargo +nightly`: it is split into words where it is run.
cargo=${CARGO:-cargo}
set -f
mkdir -p "$out"
rm -f "$out/facts"

echo "building libcarvel ($profile); what cargo says goes to $out/log"
# Without the rlib among the crate types rustc does the link-time optimisation that the
# profile asks for. A target folder of its own, because cargo gives libcarvel.so no hash
# and any other build of the package would write over it.
# shellcheck disable=SC2086
$cargo rustc --locked --lib --profile "$profile" --crate-type cdylib,staticlib \
    --no-default-features --features capi --target-dir "${CARGO_TARGET_DIR:-target}/packaged" \
    --message-format json-render-diagnostics -- --print native-static-libs \
    >"$out/messages" 2>"$out/log" || { cat "$out/log" >&2; exit 1; }

built() {
    sed -n 's/.*"\([^"]*\/libcarvel\.'"$1"'\)".*/\1/p' "$out/messages" | tail -n 1
}
shared=$(built so)
static=$(built a)
if [ -z "$shared" ] || [ -z "$static" ]; then
    echo "cargo built no libcarvel.so and libcarvel.a: only ELF systems are packaged" >&2
    exit 1
fi

# shellcheck disable=SC2086
version=$($cargo pkgid | sed 's/.*[#@]//')
soname=$(objdump -p "$shared" | sed -n 's/^ *SONAME *//p')
libs=$(sed -n 's/^note: native-static-libs: *//p' "$out/log" | tail -n 1)
# The fifth byte of an ELF file is 1 for 32 and 2 for 64 bits.
pointer=$(($(od -An -j4 -N1 -tu1 "$shared") * 4))
for fact in "$version" "$soname" "$libs"; do
    if [ -z "$fact" ]; then
        echo "no version, no SONAME or no native libraries: '$version' '$soname' '$libs'" >&2
        exit 1
    fi
done

cp "$shared" "$out/libcarvel.so"
packaging/merge.sh "$static" "$out/libcarvel.a" carvel_
cat >"$out/facts" <<END
VERSION='$version'
SONAME='$soname'
NATIVE_LIBS='$libs'
POINTER_BYTES=$pointer
END
