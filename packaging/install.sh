#!/bin/sh
# install.sh install BUILD | install.sh uninstall, as `make install` and `make uninstall`
# call it; BUILD is what build.sh filled. Taken from the environment:
#   PREFIX       /usr/local
#   LIBDIR       $PREFIX/lib; where PREFIX is /usr and the compiler or dpkg names a
#                multiarch triplet, /usr/lib/<triplet>, as Debian's packages do
#   INCLUDEDIR   $PREFIX/include
#   DESTDIR      put before all of them, for packages and stages; never written into a file
#   STRIP_DEBUG  no: keep the shared library's debug information, for packagers who
#                split it off
set -eu
cd "$(dirname "$0")/.."

fail() {
    echo "install.sh: $*" >&2
    exit 1
}

multiarch() {
    [ "$prefix" = /usr ] || return 0
    triplet=$(${CC:-cc} -print-multiarch 2>/dev/null ||
        dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || true)
    [ -z "$triplet" ] || printf '/%s' "$triplet"
}

destdir=${DESTDIR:-}
destdir=${destdir%/}
prefix=${PREFIX:-/usr/local}
prefix=${prefix%/}
libdir=${LIBDIR:-$prefix/lib$(multiarch)}
libdir=${libdir%/}
includedir=${INCLUDEDIR:-$prefix/include}
includedir=${includedir%/}
docdir=$prefix/share/doc/carvel
sharedir=$prefix/share/carvel
# Every file and folder that was made, so that uninstall takes these and no others.
manifest=$destdir$sharedir/manifest

for dir in "$prefix/" "$libdir" "$includedir"; do
    case $dir in
        [!/]* | */../* | */..) fail "'$dir' is no absolute path" ;;
        *[!A-Za-z0-9_./@%+=:,~\ -]*) fail "'$dir' has characters that pkg-config and CMake read" ;;
    esac
done

record() {
    grep -qxF "$1 $2" "$list" || printf '%s %s\n' "$1" "$2" >>"$list"
}

# What was made until then is written down even when installing fails half way.
save() {
    if [ -d "$destdir$sharedir" ]; then
        install -m 644 "$list" "$manifest"
    fi
    rm -f "$list"
}

make_dir() {
    if [ ! -d "$destdir$1" ]; then
        make_dir "$(dirname "$1")"
        install -d -m 755 "$destdir$1"
        record dir "$1"
    fi
}

put() { # MODE FILE DIR [NAME]
    record file "$3/${4:-${2##*/}}"
    install -m "$1" "$2" "$destdir$3/${4:-${2##*/}}"
}

link() { # TARGET DIR NAME
    record file "$2/$3"
    ln -sf "$1" "$destdir$2/$3"
}

# The way from folder $1 to folder $2.
relative() {
    base=$1
    up=
    while :; do
        case $2/ in "$base"/*) break ;; esac
        base=${base%/*}
        up=../$up
    done
    rest=${2#"$base"}
    rest=$up${rest#/}
    printf '%s' "${rest%/}"
}

# $1 as pkg-config writes it: below ${prefix} where it can, spaces escaped.
for_pkg_config() {
    case $1 in
        "$prefix"/*) printf '${prefix}%s' "${1#"$prefix"}" ;;
        *) printf '%s' "$1" ;;
    esac | sed 's/ /\\ /g'
}

fill() { # TEMPLATE DIR: a `|` or a `\` is in no value but the paths' escaped spaces
    sed -e "s|@VERSION@|$VERSION|g" \
        -e "s|@SERIES@|${SONAME#libcarvel.so.}|g" \
        -e "s|@SONAME@|$SONAME|g" \
        -e "s|@SHARED@|libcarvel.so.$VERSION|g" \
        -e "s|@POINTER_BYTES@|$POINTER_BYTES|g" \
        -e "s|@NATIVE_LIBS@|$NATIVE_LIBS|g" \
        -e "s|@NATIVE_LIBS_LIST@|$(echo "$NATIVE_LIBS" | tr -s ' ' ';')|g" \
        -e "s|@INCLUDE_FROM_LIB@|$(relative "$libdir" "$includedir")|g" \
        -e "s|@LIB_FROM_CMAKE@|$(relative "$libdir/cmake/carvel" "$libdir")|g" \
        -e "s|@PREFIX@|$(printf '%s' "$prefix" | sed 's/ /\\\\ /g')|g" \
        -e "s|@LIBDIR@|$(for_pkg_config "$libdir" | sed 's/\\/\\\\/g')|g" \
        -e "s|@INCLUDEDIR@|$(for_pkg_config "$includedir" | sed 's/\\/\\\\/g')|g" \
        "packaging/$1.in" >"$list.filled"
    put 644 "$list.filled" "$2" "$1"
    rm -f "$list.filled"
}

install_all() {
    [ -f "$1/facts" ] || fail "'$1' is not built: make lib"
    # shellcheck source=/dev/null
    . "$1/facts"
    places="places $prefix|$libdir|$includedir"
    list=$(mktemp)
    if [ -f "$manifest" ]; then
        cat "$manifest" >"$list"
        grep -qxF "$places" "$list" ||
            fail "what is installed has other places, uninstall it first: $(head -n 1 "$list")"
    else
        printf '%s\n' "$places" >"$list"
    fi
    trap save EXIT
    mkdir -p "$destdir/"
    make_dir "$sharedir"
    record file "$sharedir/manifest"

    make_dir "$libdir"
    put 755 "$1/libcarvel.so" "$libdir" "libcarvel.so.$VERSION"
    if [ "${STRIP_DEBUG:-yes}" != no ]; then
        "${OBJCOPY:-objcopy}" --strip-debug "$destdir$libdir/libcarvel.so.$VERSION"
    fi
    # What the loader looks for, and what `-lcarvel` finds.
    link "libcarvel.so.$VERSION" "$libdir" "$SONAME"
    link "$SONAME" "$libdir" libcarvel.so
    put 644 "$1/libcarvel.a" "$libdir"

    # A pattern that matches nothing stays as it is, and copying it fails: so it should.
    make_dir "$includedir"
    for header in include/*.h include/*.hpp; do
        put 644 "$header" "$includedir"
    done

    make_dir "$libdir/pkgconfig"
    fill carvel.pc "$libdir/pkgconfig"
    make_dir "$libdir/cmake/carvel"
    fill carvelConfig.cmake "$libdir/cmake/carvel"
    fill carvelConfigVersion.cmake "$libdir/cmake/carvel"

    make_dir "$docdir"
    for document in LICENSE-APACHE LICENSE-MIT docs/abi.md; do
        [ ! -f "$document" ] || put 644 "$document" "$docdir"
    done
    if [ -z "$destdir" ]; then
        echo "installed in $prefix, what exactly is in $sharedir/manifest"
        echo "where the loader looks in $libdir, run ldconfig; otherwise:"
        echo "  export PKG_CONFIG_PATH=$libdir/pkgconfig CMAKE_PREFIX_PATH=$prefix"
        echo "  and link with -Wl,-rpath,$libdir"
    fi
}

uninstall_all() {
    [ -f "$manifest" ] || fail "nothing is installed there: no $manifest"
    grep -qxF "places $prefix|$libdir|$includedir" "$manifest" ||
        fail "installed with other variables, or moved: $(head -n 1 "$manifest")"
    list=$(mktemp)
    cat "$manifest" >"$list"
    sed -n 's/^file //p' "$list" | while IFS= read -r file; do
        rm -f "$destdir$file"
    done
    # The deepest first; a folder that holds something else stays.
    sed -n 's/^dir //p' "$list" | sort -r | while IFS= read -r dir; do
        rmdir "$destdir$dir" 2>/dev/null || true
    done
    rm -f "$list"
}

case ${1:-} in
    install) install_all "$2" ;;
    uninstall) uninstall_all ;;
    *) fail "install BUILD or uninstall" ;;
esac
