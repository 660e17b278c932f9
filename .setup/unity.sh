# shellcheck shell=bash
# Part of setup.sh: Unity, the C test framework, into build/unity. Debian has no package of it, but
# the source package of cjson holds a copy. It is fetched by an apt with sources, state and cache
# of its own, so that the machine's stay as they are; no root is needed.
# shellcheck disable=SC2154 # here, root and work are setup.sh's

unity=$root/build/unity

unity_ready() {
    local dir=${UNITY_ROOT:-$unity}
    [ -f "$dir/unity.c" ] && [ -f "$dir/unity.h" ] && [ -f "$dir/unity_internals.h" ]
}

# source_lists SUITE ETC: writes the package sources in ETC (/etc/apt) as sources of source
# packages into $work/apt/sources. Only those of SUITE, the system's release: others cannot have
# cjson, and some may not answer. All of them when none is (Debian unstable has no release).
source_lists() {
    local suite=$1 etc=$2 out=$work/apt/sources file
    mkdir -p "$out"
    # One line a source.
    cat "$etc/sources.list" "$etc"/sources.list.d/*.list 2>/dev/null |
        sed -En 's/^deb(-src)?[[:space:]]/deb-src /p' | sort -u >"$work/apt/all.list" || true
    grep -E "[[:space:]]${suite}[[:space:]]" "$work/apt/all.list" >"$out/some.list" || true
    # The newer format: paragraphs of fields.
    for file in "$etc"/sources.list.d/*.sources; do
        [ ! -f "$file" ] || { sed '/^#/d; s/^Types:.*/Types: deb-src/' "$file"; echo; }
    done >"$work/apt/all.sources"
    awk -v suite="$suite" 'BEGIN { RS = ""; ORS = "\n\n" }
        ("\n" $0 "\n") ~ ("\nSuites:([^\n]*[ \t])?" suite "[ \t\n]")' "$work/apt/all.sources" |
        sed "s/^Suites:.*/Suites: $suite/" >"$out/some.sources"
    [ -s "$out/some.list" ] || [ -s "$out/some.sources" ] || cp "$work"/apt/all.* "$out/"
}

# Read after the machine's own settings, so that a proxy or the like still holds.
write_apt_conf() {
    mkdir -p "$work"/apt/{lists/partial,cache/archives/partial}
    cat >"$work/apt/apt.conf" <<END
Dir::Etc::SourceList "/dev/null";
Dir::Etc::SourceParts "$work/apt/sources";
Dir::State::Lists "$work/apt/lists";
Dir::Cache "$work/apt/cache";
Acquire::Languages "none";
APT::Sandbox::User "$(id -un)";
#clear APT::Update::Pre-Invoke;
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
END
}

fetch_unity() (
    private_apt() { apt-get -c "$work/apt/apt.conf" "$@"; }
    cd "$work/apt" || exit
    private_apt update
    private_apt source --download-only cjson &&
        dpkg-source -x cjson_*.dsc cjson &&
        mkdir -p "$unity.new" &&
        cp cjson/tests/unity/{src/unity{.c,.h,_internals.h},docs/license.txt} "$unity.new/" &&
        # cJSON's copy always includes its own configuration; Unity itself only when told to.
        sed -i '/^#include.*unity_config.h/{s|"../examples/|"|; i #ifdef UNITY_INCLUDE_CONFIG_H
            a #endif
            }' "$unity.new/unity_internals.h"
)

setup_unity() {
    local suite other='Unity can also be given: UNITY_ROOT=folder with unity.c and its headers'
    [ -z "${UNITY_ROOT:-}" ] ||
        die "UNITY_ROOT=$UNITY_ROOT lacks unity.c, unity.h or unity_internals.h"
    have apt-get || die 'the C test framework Unity is missing' "$other"
    say 'the C test framework Unity into build/unity'
    rm -rf "$work/apt" "$unity.new" "$unity"
    suite=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
    source_lists "${suite:-none}" /etc/apt
    write_apt_conf
    logged unity fetch_unity || die "Unity could not be had from Debian's cjson" "$other"
    mv "$unity.new" "$unity"
    rm -rf "$work/apt"
}
