#!/bin/sh
# Installs what the build and the tests need on a bare Debian: a C linker, and the
# formatter and the linter where rustup has not brought them. Rust itself is only
# looked for.
set -eu

if ! command -v cargo >/dev/null 2>&1; then
    echo "carvel needs Rust 1.88 or newer: https://rustup.rs" >&2
    exit 1
fi
minor=$(cargo --version | sed 's/^cargo 1\.\([0-9]*\).*/\1/')
if [ "$minor" -lt 88 ]; then
    echo "carvel needs Rust 1.88 or newer, this is $(cargo --version): https://rustup.rs" >&2
    exit 1
fi
for component in rustfmt clippy; do
    if ! cargo "${component#rust}" --version >/dev/null 2>&1; then
        rustup component add "$component"
    fi
done
if ! command -v cc >/dev/null 2>&1; then
    if ! command -v apt-get >/dev/null 2>&1; then
        echo "a C linker (cc) is needed and apt-get is not here to install it" >&2
        exit 1
    fi
    sudo=
    [ "$(id -u)" = 0 ] || sudo=sudo
    $sudo apt-get update -q
    $sudo apt-get install -q -y --no-install-recommends gcc libc6-dev
fi
