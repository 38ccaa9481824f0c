#!/bin/sh
# Two threads share a mesh, a scheme, a context and a hierarchy, and one refiner, under
# ThreadSanitizer: the library and its crates instrumented by a nightly compiler,
# tests/capi/c/threads.c by gcc, and the runtime that comes with Rust. Without a nightly
# toolchain, or with RACES=helgrind, Helgrind looks at a serial context alone.
#
#   tests/capi/tsan.sh [rounds]
#
# Silence means something: first, a race that is planted in the program must be seen.
#
# What is judged: with a serial context everything, nothing suppressed under
# ThreadSanitizer. With a pool of threads only what happens outside of rayon's calls:
# handles, errors, flags, the hosts' own memory. The work that a pool is given is not
# judged there (tests/capi/c/tsan.supp says why); that it writes to places of its own
# alone follows from Rust's rules, but for the library's unsafe code.
set -eu
export LC_ALL=C
cd "$(dirname "$0")/../.."
out=${CARGO_TARGET_DIR:-target}/tsan
mkdir -p "$out"

fail() {
    echo "tsan.sh: $*" >&2
    exit 1
}

objects() { # DIRECTORY FLAGS...: the program, and with a planted race
    directory=$1
    shift
    mkdir -p "$directory"
    for source in threads check fixture; do
        gcc -std=c99 -g -O1 -pthread "$@" -Iinclude -Itests/capi/c \
            -c "tests/capi/c/$source.c" -o "$directory/$source.o"
    done
    gcc -std=c99 -g -O1 -pthread -DPLANTED "$@" -Iinclude -Itests/capi/c \
        -c tests/capi/c/threads.c -o "$directory/planted.o"
}

link() { # DIRECTORY LIBRARY FLAGS...
    directory=$1
    shift
    for name in threads planted; do
        gcc "$directory/$name.o" "$directory/check.o" "$directory/fixture.o" "$@" \
            -lgcc_s -lutil -lrt -lpthread -lm -ldl -lc -o "$directory/$name"
    done
}

# A tool that says nothing of the planted race, or not where the library writes, is blind.
must_see() { # LOG PATTERN COMMAND...
    log=$1
    pattern=$2
    shift 2
    if "$@" >"$log" 2>&1 || ! grep -q "$pattern" "$log" || ! grep -q "carvel::" "$log"; then
        tail -n 40 "$log" >&2
        fail "the planted race was not seen: $*"
    fi
}

helgrind() {
    cat >&2 <<END
********************************************************************************
* $1
* Helgrind judges a serial context ONLY: no pool of threads is looked at.
********************************************************************************
END
    command -v valgrind >/dev/null || fail "neither ThreadSanitizer nor valgrind is installed"
    # Unoptimised, so that atomic operations have frames that a suppression can name.
    # shellcheck disable=SC2086
    ${CARGO:-cargo} build --locked --package carvel --lib --no-default-features \
        --features capi --target-dir "$out"
    objects "$out/helgrind"
    link "$out/helgrind" "$out/debug/libcarvel.a"
    set -- valgrind --tool=helgrind --error-exitcode=9 --num-callers=30 \
        --suppressions=tests/capi/c/helgrind.supp
    must_see "$out/planted.log" 'Possible data race' "$@" "$out/helgrind/planted" 1 serial
    "$@" --quiet "$out/helgrind/threads" "$rounds" serial
    echo "Helgrind: the planted race seen, no other in threads.c with a serial context"
    exit 0
}

rounds=${1:-2}
[ "${RACES:-}" != helgrind ] || helgrind "RACES=helgrind"
root=$(rustc +nightly --print sysroot 2>/dev/null) ||
    helgrind "ThreadSanitizer needs a nightly toolchain (rustup toolchain install nightly)."
host=$(rustc -vV | sed -n 's/^host: //p')
runtime=$root/lib/rustlib/$host/lib/librustc-nightly_rt.tsan.a
[ -f "$runtime" ] || helgrind "The nightly toolchain has no ThreadSanitizer for $host."

rounds=${1:-30}
RUSTFLAGS="-Zsanitizer=thread -Cunsafe-allow-abi-mismatch=sanitizer" \
    cargo +nightly build --locked --package carvel --lib --no-default-features \
    --features capi --release --target "$host" --target-dir "$out"
objects "$out/objects" -fsanitize=thread
# Not -fsanitize=thread here: that would be gcc's runtime, which lacks functions
# that Rust's code calls.
link "$out/objects" "$out/$host/release/libcarvel.a" \
    -Wl,--whole-archive "$runtime" -Wl,--no-whole-archive
must_see "$out/planted.log" 'WARNING: ThreadSanitizer: data race' "$out/objects/planted" 5 serial
"$out/objects/threads" "$rounds" serial
TSAN_OPTIONS="suppressions=tests/capi/c/tsan.supp" "$out/objects/threads" "$rounds" pool
echo "ThreadSanitizer: the planted race seen, no other in threads.c"
