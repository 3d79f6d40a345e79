#!/usr/bin/env bash
# Prepares a machine and this clone for `cargo run` and `cargo test`: installs what is missing and builds shaderc once
# for all clones of this user. Running it again is quick and changes nothing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

say() { printf 'setup: %s\n' "$*"; }
warn() { printf 'setup: warning: %s\n' "$*" >&2; }
die() {
    printf 'setup: error: %s\n' "$*" >&2
    exit 1
}
has() { command -v "$1" >/dev/null 2>&1; }

as_root() {
    if ((EUID == 0)); then
        "$@"
    else
        sudo "$@"
    fi
}

# ---- Packages. `required` is what the build cannot do without; `optional` is for running, the window and the tests:
# its names may differ on other versions of a distribution, so one that cannot be had is a warning.

debian_packages() {
    required=(build-essential pkg-config cmake git python3 libvulkan1)
    optional=(mesa-vulkan-drivers libx11-6 libx11-xcb1 libxcursor1 libxi6 libxkbcommon0 libxkbcommon-x11-0 libxcb-xkb1
        ninja-build vulkan-validationlayers xvfb xauth xdotool imagemagick shellcheck chromium)
}
debian_missing() {
    local installed package
    # shellcheck disable=SC2016 # dpkg-query expands these, not the shell.
    installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "$@" 2>/dev/null || true)
    for package in "$@"; do
        grep -qxF "$package installed" <<<"$installed" || echo "$package"
    done
}
debian_refresh() { as_root apt-get update -qq; }
debian_install() { as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@"; }

fedora_packages() {
    required=(gcc gcc-c++ make pkgconf-pkg-config cmake git python3 vulkan-loader)
    optional=(mesa-vulkan-drivers libX11 libX11-xcb libXcursor libXi libxkbcommon libxkbcommon-x11 libxcb
        ninja-build vulkan-validation-layers xorg-x11-server-Xvfb xorg-x11-xauth xdotool ImageMagick ShellCheck
        chromium)
}
fedora_missing() {
    local package
    for package in "$@"; do
        rpm -q --quiet --whatprovides "$package" || echo "$package"
    done
}
fedora_refresh() { :; }
fedora_install() { as_root dnf install -y "$@"; }

arch_packages() {
    required=(gcc make pkgconf cmake git python vulkan-icd-loader)
    optional=(vulkan-swrast libx11 libxcursor libxi libxkbcommon libxkbcommon-x11 libxcb ninja
        vulkan-validation-layers xorg-server-xvfb xorg-xauth xdotool imagemagick shellcheck
        chromium)
}
arch_missing() { pacman -T "$@" || true; }
# Only where there is no package list at all: refreshing an old one without upgrading breaks Arch machines.
arch_refresh() { [[ -e /var/lib/pacman/sync/core.db ]] || as_root pacman -Sy --noconfirm; }
arch_install() { as_root pacman -S --needed --noconfirm "$@"; }

install_packages() {
    local distribution=$1 required optional package
    "${distribution}_packages"
    mapfile -t required < <("${distribution}_missing" "${required[@]}")
    mapfile -t optional < <("${distribution}_missing" "${optional[@]}")
    ((${#required[@]} + ${#optional[@]})) || return 0

    say "missing packages: ${required[*]} ${optional[*]}"
    if ((EUID != 0)) && ! has sudo; then
        die "installing them needs root: run this as root, or install sudo"
    fi
    "${distribution}_refresh" || warn "could not refresh the package lists; going on with the old ones"
    if ((${#required[@]})); then
        "${distribution}_install" "${required[@]}" || die "could not install ${required[*]}"
    fi
    # One unknown name fails a whole call, so after a failure each is tried alone.
    if ((${#optional[@]})) && ! "${distribution}_install" "${optional[@]}"; then
        for package in "${optional[@]}"; do
            "${distribution}_install" "$package" || warn "could not install $package (needed to run or to test)"
        done
    fi
}

check_build_tools() {
    local tool missing=()
    warn "this system's package manager is unknown here. zerkalo needs: a C++ compiler, make or ninja, pkg-config," \
        "cmake, git, python3; the Vulkan loader and a Vulkan 1.2 driver; libX11, libX11-xcb, libXcursor, libXi," \
        "libxkbcommon, libxkbcommon-x11; for the tests also the Vulkan validation layers, Xvfb, xauth, xdotool," \
        "ImageMagick, ShellCheck and Chromium"
    for tool in c++ cmake git python3; do
        has "$tool" || missing+=("$tool")
    done
    ((${#missing[@]} == 0)) || die "not found: ${missing[*]}"
}

# ---- shaderc. The distributions' library does not link with the crate, and building the crate's copy takes minutes in
# every clean clone. So it is built once here, and a links override makes cargo skip the crate's own build.

cache_folder() {
    local home=${HOME:-$(getent passwd "$EUID" | cut -d: -f6)}
    local cache=${XDG_CACHE_HOME:-}
    # The XDG specification says to ignore a relative path.
    [[ $cache == /* ]] || cache=${home:+$home/.cache}
    [[ -n $cache ]] || die "neither HOME nor XDG_CACHE_HOME says where to keep the shaderc library"
    echo "$cache/zerkalo"
}

build_shaderc() {
    local version=$1 folder=$2 cache=$3 library
    exec {lock}>"$cache/lock"
    if ! flock -n "$lock"; then
        say "waiting for another setup.sh to finish building shaderc"
        flock "$lock"
    fi
    [[ -e $folder/libshaderc_combined.a ]] && return
    # Left by a run that was killed; none is running now.
    rm -rf "$cache"/build.*

    say "building shaderc $version: some minutes, once for this user"
    build=$(mktemp -d "$cache/build.XXXXXX")
    trap 'rm -rf "$build"' EXIT
    mkdir "$build/src"
    : >"$build/src/lib.rs"
    # cargo cannot build a dependency of a build script by name (its resolver panics), so a package is made around it.
    cat >"$build/Cargo.toml" <<TOML
[package]
name = "shaderc-once"
version = "0.0.0"
edition = "2024"

[dependencies]
shaderc-sys = { version = "=$version", features = ["build-from-source"] }

[workspace]
TOML
    # For the same versions of what builds it.
    cp Cargo.lock "$build/"
    (cd "$build" && cargo build --release --target-dir "$build/target" {lock}>&-) || die "could not build shaderc"
    library=$(find "$build/target" -path '*/shaderc-sys-*/out/lib*/libshaderc_combined.a' -print -quit)
    [[ -n $library ]] || die "the build of shaderc-sys $version left no libshaderc_combined.a"
    mkdir -p "$folder"
    # The rename is what makes it there for others: never a half-written library.
    mv "$library" "$folder/libshaderc_combined.a.new"
    mv "$folder/libshaderc_combined.a.new" "$folder/libshaderc_combined.a"
    rm -rf "$build"
    exec {lock}>&-
}

link_shaderc() {
    local version host cache folder quoted wanted config=.cargo/config.toml
    local marker="# Written by zerkalo's setup.sh, which will overwrite it; remove this line to keep your changes."
    version=$(sed -n '/^name = "shaderc-sys"$/{n;s/^version = "\(.*\)"$/\1/p;}' Cargo.lock)
    [[ -n $version ]] || die "Cargo.lock names no shaderc-sys"
    host=$(rustc -vV | sed -n 's/^host: //p')
    cache=$(cache_folder)
    folder=$cache/shaderc-sys-$version-$host
    mkdir -p "$cache"
    [[ -e $folder/libshaderc_combined.a ]] || build_shaderc "$version" "$folder" "$cache"

    quoted=${folder//\\/\\\\}
    quoted=${quoted//\"/\\\"}
    wanted="[target.$host.shaderc]
rustc-link-search = [\"native=$quoted\"]
rustc-link-lib = [\"static=shaderc_combined\"]"
    if [[ ! -e $config ]] || [[ $(head -n 1 "$config") == "$marker" ]]; then
        mkdir -p .cargo
        [[ -e $config && $(<"$config") == "$marker"$'\n'"$wanted" ]] ||
            { printf '%s\n' "$marker" "$wanted" >"$config.new" && mv "$config.new" "$config"; }
    elif ! grep -qF "native=$quoted" "$config"; then
        warn "$config is yours and stays as it is; so that cargo need not build shaderc, add to it:"
        printf '%s\n' "$wanted" >&2
    fi
}

main() {
    if has apt-get && has dpkg-query; then
        install_packages debian
    elif has dnf && has rpm; then
        install_packages fedora
    elif has pacman; then
        install_packages arch
    else
        check_build_tools
    fi

    # Under `sudo ./setup.sh` the rest belongs to the user whose clone this is: their cargo, their cache.
    if ((EUID == 0)) && [[ -n ${SUDO_USER:-} && $SUDO_USER != root && $(stat -c %U .) == "$SUDO_USER" ]]; then
        exec sudo -H -u "$SUDO_USER" -- "$PWD/setup.sh"
    fi

    # rustup puts cargo there, and neither a fresh shell nor sudo may know it yet.
    has cargo || PATH="${HOME:-}/.cargo/bin:$PATH"
    if ! has cargo || ! has rustc; then
        die "cargo not found: install Rust as https://rustup.rs says, then run this again"
    fi
    link_shaderc
    say "ready"
}

main
