#!/bin/sh
# Two threads share a mesh, a scheme, a context and a hierarchy under
# ThreadSanitizer: the library and its crates instrumented by a nightly compiler,
# tests/capi/c/threads.c by gcc, and the runtime that comes with Rust.
#
#   tests/capi/tsan.sh [rounds]
set -eu
cd "$(dirname "$0")/../.."

host=$(rustc -vV | sed -n 's/^host: //p')
if ! root=$(rustc +nightly --print sysroot 2>&1); then
    echo "SKIPPED: ThreadSanitizer needs a nightly toolchain (rustup toolchain install nightly)" >&2
    exit 0
fi
runtime=$root/lib/rustlib/$host/lib/librustc-nightly_rt.tsan.a
if ! [ -f "$runtime" ]; then
    echo "SKIPPED: the nightly toolchain has no ThreadSanitizer for $host" >&2
    exit 0
fi

out=${CARGO_TARGET_DIR:-target}/tsan
RUSTFLAGS="-Zsanitizer=thread -Cunsafe-allow-abi-mismatch=sanitizer" \
    cargo +nightly build --locked --package carvel --lib --no-default-features \
    --features capi --release --target "$host" --target-dir "$out"

for source in threads check fixture; do
    gcc -std=c99 -g -O1 -pthread -fsanitize=thread -Iinclude -Itests/capi/c \
        -c "tests/capi/c/$source.c" -o "$out/$source.o"
done
# Not -fsanitize=thread here: that would be gcc's runtime, which lacks functions
# that Rust's code calls.
gcc "$out/threads.o" "$out/check.o" "$out/fixture.o" \
    "$out/$host/release/libcarvel.a" \
    -Wl,--whole-archive "$runtime" -Wl,--no-whole-archive \
    -lgcc_s -lutil -lrt -lpthread -lm -ldl -lc -o "$out/threads"
TSAN_OPTIONS="suppressions=tests/capi/c/tsan.supp" "$out/threads" "${1:-30}"
echo "ThreadSanitizer: no race in threads.c"
