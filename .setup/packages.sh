# shellcheck shell=bash
# Part of setup.sh: the Debian packages of packages.txt; without apt-get, only a look whether the
# libraries are there.
# shellcheck disable=SC2154 # here, root and work are setup.sh's

install=(apt-get install -y --no-install-recommends)

# install_command NAMES: what a person can type.
install_command() { echo "sudo ${install[*]}" "$(tr -s '\n ' ' ' <<<"$1" | sed 's/ $//')"; }

# listed [required|optional|book]: names from packages.txt, for this checkout; the book's only if
# they are asked for.
listed() {
    local grader=0
    [ ! -d "$root/grader" ] || grader=1
    sed 's/#.*//' "$here/packages.txt" | awk -v want="${1:-}" -v grader="$grader" '
        NF && ($2 != "grader" || grader) {
            kind = $2 == "optional" || $2 == "book" ? $2 : "required"
            if (want == kind || (want == "" && kind != "book")) print $1 }'
}

# missing required|optional|book: the listed packages that are not installed.
missing() {
    local names installed
    mapfile -t names < <(listed "$1")
    # dpkg-query also fails for a package that it has never heard of.
    installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${names[@]}" 2>/dev/null |
        sed -n 's/^installed //p') || true
    printf '%s\n' "${names[@]}" | grep -vxF "$installed" || true
}

# Optional packages are tried once per state of the list; this file remembers it.
tried() { cmp -s "$here/packages.txt" "$work/optional-tried"; }

packages_ready() {
    have apt-get || { [ -z "$(absent_libraries)" ]; return; }
    [ -z "$(missing required)" ] && { tried || [ -z "$(missing optional)" ]; }
}

# Sets as_root to what runs a command as root; fails where that would need a password and nobody
# is there to give it.
find_root() {
    as_root=()
    [ "$(id -u)" != 0 ] || return 0
    have sudo || return 1
    as_root=(sudo)
    sudo -n true 2>/dev/null || { [ -t 0 ] && [ -t 1 ]; }
}

apt_install() {
    logged "$1" "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        "${install[@]}" -o DPkg::Lock::Timeout=300 "${@:2}"
}

setup_packages() {
    local required optional name
    have apt-get || refuse_libraries
    mapfile -t required < <(missing required)
    mapfile -t optional < <(missing optional)
    if find_root; then
        say "installing ${#required[@]} system packages and ${#optional[@]} optional ones"
        # A source of the machine's that does not answer need not hold a package of ours.
        logged apt-update "${as_root[@]}" apt-get update || say 'going on without apt-get update'
        [ ${#required[@]} = 0 ] || apt_install apt-install "${required[@]}" ||
            die "apt-get could not install: ${required[*]}"
        for name in "${optional[@]}"; do
            apt_install "apt-$name" "$name" 2>/dev/null || say "going on without $name (optional)"
        done
    else
        [ ${#required[@]} = 0 ] || die 'system packages are missing; this installs them:' \
            "    $(install_command "${required[*]} ${optional[*]}")"
        say "going on without ${optional[*]} (optional; needs root)"
    fi
    cp "$here/packages.txt" "$work/optional-tried"
}

# ---- no apt-get: check only ----

includes() { printf '#include <%s>\n' "$1" | "${CC:-cc}" -E -x c - >/dev/null 2>&1; }

absent_libraries() {
    have "${CC:-cc}" || echo "a C compiler (${CC:-cc})"
    pkg-config --exists OpenEXR 2>/dev/null || echo 'OpenEXR (for pkg-config: OpenEXR)'
    pkg-config --exists libcjson 2>/dev/null || echo 'cJSON (for pkg-config: libcjson)'
    includes stb/stb_image.h || includes stb_image.h || echo 'stb (stb/stb_image.h)'
}

refuse_libraries() {
    local absent
    mapfile -t absent < <(absent_libraries)
    die 'there is no apt-get here; please install, then try again:' "${absent[@]/#/    }"
}
