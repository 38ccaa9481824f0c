#!/bin/sh
# Installs what the build needs on a bare Debian: a C linker, and the formatter and the
# linter where rustup has not brought them. Rust itself is only looked for.
# `install.sh tests`: also the compilers, libraries and checkers of the C and C++ tests,
# and the libraries that carvel is compared with.
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

# The Debian packages that are missing, each known by a command or a file of its own.
missing=
command_of() { # COMMAND PACKAGE
    command -v "$1" >/dev/null 2>&1 || missing="$missing $2"
}
file_of() { # PACKAGE FILE..., of which one is enough
    package=$1
    shift
    for file; do
        [ ! -e "$file" ] || return 0
    done
    missing="$missing $package"
}

command_of cc "gcc libc6-dev"
if [ "${1:-}" = tests ]; then
    command_of g++ g++
    command_of clang clang
    command_of cmake cmake
    command_of pkg-config pkg-config
    command_of valgrind valgrind
    command_of abidiff abigail-tools
    command_of objcopy binutils
    file_of libc6-dev /usr/include/stdio.h
    file_of libclang-dev /usr/lib/llvm-*/lib/libclang.so /usr/lib*/libclang.so
    file_of libopenmesh-dev /usr/include/OpenMesh /usr/local/include/OpenMesh
    file_of libosd-dev /usr/include/opensubdiv /usr/local/include/opensubdiv
    file_of libcgal-dev /usr/include/CGAL /usr/local/include/CGAL
    file_of libeigen3-dev /usr/include/eigen3 /usr/local/include/eigen3
fi
if [ -n "$missing" ]; then
    if ! command -v apt-get >/dev/null 2>&1; then
        echo "needed, and apt-get is not here to install it:$missing" >&2
        exit 1
    fi
    sudo=
    [ "$(id -u)" = 0 ] || sudo=sudo
    $sudo apt-get update -q
    # shellcheck disable=SC2086
    $sudo apt-get install -q -y --no-install-recommends $missing
fi
