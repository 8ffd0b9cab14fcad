# Sourced by ./run and ./test with `root` set to this project's folder: installs what is missing and builds.
# Nothing here asks a question; everything is skipped when there is nothing to do.

say() { printf '\033[1m%s\033[0m\n' "overt: $*" >&2; }

# Installs the packages of packages.txt that the machine lacks, or says how when it may not.
install_packages() {
    command -v dpkg-query >/dev/null || { say "this is no Debian system; install the libraries of packages.txt yourself"; return; }
    local wanted missing=() package
    wanted=$(grep -v '^#' "$root/packages.txt")
    for package in $wanted; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    local install=(env DEBIAN_FRONTEND=noninteractive apt-get)
    if [ "$(id -u)" -ne 0 ]; then
        if sudo -n true 2>/dev/null; then
            install=(sudo "${install[@]}")
        else
            say "these packages are missing, and installing them needs root:"
            printf '\n    sudo apt-get install --no-install-recommends %s\n\n' "${missing[*]}" >&2
            exit 1
        fi
    fi
    say "installing ${#missing[@]} packages: ${missing[*]}"
    "${install[@]}" update -qq || say "the package lists could not be renewed; going on with those that are here"
    "${install[@]}" install -y -qq --no-install-recommends -o Dpkg::Use-Pty=0 "${missing[@]}" >/dev/null || {
        say "apt-get failed; try it yourself: apt-get install --no-install-recommends ${missing[*]}"
        exit 1
    }
}

# Configures the preset $1 and builds the targets after it (all, if there are none), showing ninja's progress; silent when
# they are up to date.
build() {
    local preset=$1 folder="$root/build/$1"
    shift
    # A folder that was copied or moved here was configured for another place.
    if [ -f "$folder/CMakeCache.txt" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
        rm -rf "$folder"
    fi
    if [ ! -f "$folder/build.ninja" ]; then
        say "configuring ($preset)"
        (cd "$root" && cmake --preset "$preset" >"$root/build.log" 2>&1) || { cat "$root/build.log" >&2; say "configuring failed"; exit 1; }
        rm -f "$root/build.log"
    fi
    if ! ninja -C "$folder" -n "$@" 2>/dev/null | grep -q 'no work to do'; then
        say "building ($preset), a few minutes the first time"
        ninja -C "$folder" "$@" >&2 || { say "building failed"; exit 1; }
    fi
}
