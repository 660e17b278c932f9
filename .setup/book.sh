# shellcheck shell=bash
# Part of setup.sh, for `make book` alone: node, qpdf, and what the book is set with (KaTeX,
# typefaces), into build/node. The lock has the hash of every package; none runs a script of its own.
# shellcheck disable=SC2154 # here, root and work are setup.sh's

node_modules=$root/build/node

book_ready() {
    [ -z "$(absent_tools)" ] && [ -d "$node_modules/node_modules" ] &&
        cmp -s "$here/book/package-lock.json" "$node_modules/lock.stamp"
}

# absent_tools: Debian's packages for the commands that are not there; a node from elsewhere will do.
absent_tools() {
    have node || echo nodejs
    have npm || echo npm
    have qpdf || echo qpdf
}

find_tools() {
    local names
    mapfile -t names < <(absent_tools)
    [ ${#names[@]} != 0 ] || return 0
    have apt-get || die "the book needs programs that are missing: ${names[*]}"
    find_root || die 'the book needs packages that are missing; this installs them:' \
        "    $(install_command "${names[*]}")"
    say "installing ${names[*]} for the book"
    logged apt-update "${as_root[@]}" apt-get update || say 'going on without apt-get update'
    apt_install apt-book "${names[@]}" || die "apt-get could not install: ${names[*]}"
}

setup_book() {
    find_tools
    ! cmp -s "$here/book/package-lock.json" "$node_modules/lock.stamp" || return 0
    say "the book's typefaces and KaTeX into build/node"
    rm -rf "$node_modules"
    mkdir -p "$node_modules"
    cp "$here"/book/package.json "$here"/book/package-lock.json "$node_modules/"
    logged npm npm --prefix "$node_modules" ci --ignore-scripts --no-audit --no-fund ||
        die 'npm could not install what the book is set with; the next run tries again'
    cp "$here/book/package-lock.json" "$node_modules/lock.stamp"
}
