#!/bin/sh
# Installs what the build needs on a bare Debian: a C linker. Rust itself comes
# from rustup or the distribution and is only looked for.
set -eu

if ! command -v cargo >/dev/null 2>&1; then
    echo "carvel needs Rust 1.88 or newer: https://rustup.rs" >&2
    exit 1
fi
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
