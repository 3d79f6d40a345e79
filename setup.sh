#!/usr/bin/env bash
# Prepares a machine and this clone for `cargo run`, and with --tests for `cargo test`: installs what is missing and finds
# a shaderc to link, which is the distribution's where that works, else one that is built once for all clones of this
# user. Running it again is quick and changes nothing.
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

# ---- Packages. `required` is what the build cannot do without; `optional` is for running, the window and, asked for,
# the tests: its names may differ on other versions of a distribution, so one that cannot be had is a warning. So is one
# of `shaderc`: without it the library is built from source, which takes what `source` names.

debian_packages() {
    required=(build-essential libvulkan1)
    optional=(mesa-vulkan-drivers libx11-6 libx11-xcb1 libxcursor1 libxi6 libxkbcommon0 libxkbcommon-x11-0 libxcb-xkb1)
    tests=(vulkan-validationlayers xvfb xauth xdotool imagemagick shellcheck chromium povray)
    shaderc=(libshaderc-dev glslang-dev spirv-tools)
    source=(cmake git python3 ninja-build)
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
    required=(gcc gcc-c++ vulkan-loader)
    optional=(mesa-vulkan-drivers libX11 libX11-xcb libXcursor libXi libxkbcommon libxkbcommon-x11 libxcb)
    tests=(vulkan-validation-layers xorg-x11-server-Xvfb xorg-x11-xauth xdotool ImageMagick ShellCheck chromium povray)
    shaderc=(libshaderc-devel libshaderc-static glslang-devel spirv-tools-devel)
    source=(make cmake git python3 ninja-build)
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
    required=(gcc vulkan-icd-loader)
    optional=(vulkan-swrast libx11 libxcursor libxi libxkbcommon libxkbcommon-x11 libxcb)
    tests=(vulkan-validation-layers xorg-server-xvfb xorg-xauth xdotool imagemagick shellcheck chromium povray)
    shaderc=(shaderc)
    source=(make cmake git python ninja)
}
arch_missing() { pacman -T "$@" || true; }
# Only where there is no package list at all: refreshing an old one without upgrading breaks Arch machines.
arch_refresh() { [[ -e /var/lib/pacman/sync/core.db ]] || as_root pacman -Sy --noconfirm; }
arch_install() { as_root pacman -S --needed --noconfirm "$@"; }

# Of the distribution $1, what its list `required` or, with a warning for what cannot be had, another one names.
install_packages() {
    local distribution=$1 need=$2 package packages
    shift 2
    mapfile -t packages < <("${distribution}_missing" "$@")
    ((${#packages[@]})) || return 0

    say "missing packages: ${packages[*]}"
    if ((EUID != 0)) && ! has sudo; then
        [[ $need == optional ]] || die "installing them needs root: run this as root, or install sudo"
        warn "installing them needs root, and there is no sudo"
        return 0
    fi
    if [[ -z ${refreshed:-} ]]; then
        "${distribution}_refresh" || warn "could not refresh the package lists; going on with the old ones"
        refreshed=1
    fi
    "${distribution}_install" "${packages[@]}" && return 0
    [[ $need == optional ]] || die "could not install ${packages[*]}"
    # One unknown name fails a whole call, so after a failure each is tried alone.
    for package in "${packages[@]}"; do
        "${distribution}_install" "$package" || warn "could not install $package"
    done
}

# Names of what cannot be installed from here, for a system whose package manager is unknown.
name_what_is_needed() {
    warn "this system's package manager is unknown here. zerkalo needs: a C++ compiler; shaderc with its static or" \
        "shared library, or what builds it: make or ninja, cmake, git, python3; the Vulkan loader and a Vulkan 1.2" \
        "driver; libX11, libX11-xcb, libXcursor, libXi, libxkbcommon, libxkbcommon-x11; for the tests also the Vulkan" \
        "validation layers, Xvfb, xauth, xdotool, ImageMagick, ShellCheck, Chromium and POV-Ray"
}

need_tools() {
    local tool missing=()
    for tool in "$@"; do
        has "$tool" || missing+=("$tool")
    done
    ((${#missing[@]} == 0)) || die "not found: ${missing[*]}"
}

# ---- shaderc. The crate does not link with the distributions' library by itself: theirs is in parts, of which it asks
# for one, and building the crate's own copy takes minutes in every clean clone. So a links override tells cargo what to
# link: all of the distribution's parts where a trial program links with them and compiles a kernel, else a library that
# is built once here.

# In the order in which a linker needs them. Which of them there are differs by their versions.
SHADERC_PARTS=(shaderc_combined shaderc shaderc_util glslang MachineIndependent GenericCodeGen OSDependent OGLCompiler
    HLSL SPIRV SPVRemapper SPIRV-Tools-opt SPIRV-Tools)

# The calls of src/gpu/shader_compiler.rs, for a kernel with doubles and specialization constants.
trial_program() {
    cat <<'C'
#include <shaderc/shaderc.h>
#include <stdio.h>
#include <string.h>

static const char kernel[] =
    "#version 460\n"
    "layout(local_size_x_id = 0, local_size_y = 1) in;\n"
    "layout(constant_id = 1) const double STEP = 0.1lf;\n"
    "layout(constant_id = 2) const uint COUNT = 3;\n"
    "layout(std430, binding = 0) buffer Sums { double sums[]; };\n"
    "void main() {\n"
    "    precise double sum = sums[gl_GlobalInvocationID.x];\n"
    "    for (uint i = 0; i < COUNT; ++i) sum += STEP * OFFSET;\n"
    "    sums[gl_GlobalInvocationID.x] = sqrt(sum);\n"
    "}\n";

static shaderc_include_result *include(void *data, const char *wanted, int kind, const char *from, size_t depth) {
    (void)data, (void)wanted, (void)kind, (void)from, (void)depth;
    return 0;
}
static void release(void *data, shaderc_include_result *result) { (void)data, (void)result; }

int main(void) {
    shaderc_compiler_t compiler = shaderc_compiler_initialize();
    shaderc_compile_options_t options = shaderc_compile_options_initialize();
    shaderc_compile_options_set_target_env(options, shaderc_target_env_vulkan, shaderc_env_version_vulkan_1_2);
    shaderc_compile_options_set_optimization_level(options, shaderc_optimization_level_performance);
    shaderc_compile_options_set_warnings_as_errors(options);
    shaderc_compile_options_set_generate_debug_info(options);
    shaderc_compile_options_set_include_callbacks(options, include, release, 0);
    shaderc_compile_options_add_macro_definition(options, "OFFSET", 6, "2.0lf", 5);
    shaderc_compilation_result_t result = shaderc_compile_into_spv(
        compiler, kernel, strlen(kernel), shaderc_compute_shader, "trial.comp", "main", options);
    int works = shaderc_result_get_compilation_status(result) == shaderc_compilation_status_success &&
                shaderc_result_get_num_warnings(result) == 0 && shaderc_result_get_length(result) > 0;
    fputs(shaderc_result_get_error_message(result), stderr);
    return works ? 0 : 1;
}
C
}

# Whether the trial program links with `$@` and compiles its kernel.
shaderc_works_with() {
    local trial=$1
    shift
    c++ "$trial/trial.o" -o "$trial/trial" "$@" >>"$trial/log" 2>&1 && "$trial/trial" >>"$trial/log" 2>&1
}

# Sets `search` and `libraries` to what cargo is to link; false where the distribution's shaderc does not work.
find_distribution_shaderc() {
    local trial part path parts=() folders=()
    has c++ || return 1
    trial=$(mktemp -d)
    # shellcheck disable=SC2064 # This folder, now.
    trap "rm -rf '$trial'" RETURN
    trial_program >"$trial/trial.c"
    cc -c "$trial/trial.c" -o "$trial/trial.o" >"$trial/log" 2>&1 || return 1

    for part in "${SHADERC_PARTS[@]}"; do
        # It prints the bare name where it finds no such file.
        path=$(c++ -print-file-name="lib$part.a")
        [[ $path == /* ]] || continue
        # The combined archive and its two parts have the same objects.
        [[ $part == shaderc || $part == shaderc_util ]] && [[ " ${parts[*]} " == *" shaderc_combined "* ]] && continue
        parts+=("$part")
        folders+=("$(dirname "$(readlink -f "$path")")")
    done
    if ((${#parts[@]})) && shaderc_works_with "$trial" "${folders[@]/#/-L}" -Wl,-Bstatic "${parts[@]/#/-l}" -Wl,-Bdynamic
    then
        mapfile -t search < <(printf '%s\n' "${folders[@]}" | sort -u)
        libraries=("${parts[@]/#/static=}" "dylib=stdc++")
        return
    fi
    if shaderc_works_with "$trial" -lshaderc_shared; then
        search=()
        libraries=("dylib=shaderc_shared")
        return
    fi
    return 1
}

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

# Sets `search` and `libraries` to the library that this user's clones share, which is built where there is none yet.
find_built_shaderc() {
    local version=$1 host=$2 cache folder
    cache=$(cache_folder)
    folder=$cache/shaderc-sys-$version-$host
    mkdir -p "$cache"
    if [[ ! -e $folder/libshaderc_combined.a ]]; then
        if [[ -n $distribution ]]; then
            install_packages "$distribution" required "${source[@]}"
        fi
        need_tools c++ cmake git python3
        build_shaderc "$version" "$folder" "$cache"
    fi
    search=("$folder")
    libraries=("static=shaderc_combined" "dylib=stdc++")
}

# A TOML array of strings.
toml_array() {
    local item array=
    for item in "$@"; do
        item=${item//\\/\\\\}
        array+="${array:+, }\"${item//\"/\\\"}\""
    done
    echo "[$array]"
}

link_shaderc() {
    local version host wanted search libraries config=.cargo/config.toml
    local marker="# Written by zerkalo's setup.sh, which will overwrite it; remove this line to keep your changes."
    version=$(sed -n '/^name = "shaderc-sys"$/{n;s/^version = "\(.*\)"$/\1/p;}' Cargo.lock)
    [[ -n $version ]] || die "Cargo.lock names no shaderc-sys"
    host=$(rustc -vV | sed -n 's/^host: //p')
    if find_distribution_shaderc; then
        say "shaderc: the distribution's (${libraries[*]})"
    else
        say "shaderc: the distribution's does not link or compile a kernel with doubles; one built from source serves"
        find_built_shaderc "$version" "$host"
    fi

    wanted="[target.$host.shaderc]
rustc-link-search = $(toml_array "${search[@]/#/native=}")
rustc-link-lib = $(toml_array "${libraries[@]}")"
    if [[ ! -e $config ]] || [[ $(head -n 1 "$config") == "$marker" ]]; then
        mkdir -p .cargo
        [[ -e $config && $(<"$config") == "$marker"$'\n'"$wanted" ]] ||
            { printf '%s\n' "$marker" "$wanted" >"$config.new" && mv "$config.new" "$config"; }
    elif ! grep -qF "rustc-link-lib = $(toml_array "${libraries[@]}")" "$config"; then
        warn "$config is yours and stays as it is; so that cargo need not build shaderc, add to it:"
        printf '%s\n' "$wanted" >&2
    fi
}

main() {
    local distribution='' required optional tests shaderc source refreshed=''
    case ${1:-} in
        '' | --tests) ;;
        *) die "unknown argument '$1'; it takes none, or --tests" ;;
    esac
    if has apt-get && has dpkg-query; then
        distribution=debian
    elif has dnf && has rpm; then
        distribution=fedora
    elif has pacman; then
        distribution=arch
    fi
    if [[ -n $distribution ]]; then
        "${distribution}_packages"
        [[ ${1:-} != --tests ]] || optional+=("${tests[@]}")
        install_packages "$distribution" required "${required[@]}"
        install_packages "$distribution" optional "${optional[@]}" "${shaderc[@]}"
    else
        name_what_is_needed
        need_tools c++
    fi

    # Under `sudo ./setup.sh` the rest belongs to the user whose clone this is: their cargo, their cache.
    if ((EUID == 0)) && [[ -n ${SUDO_USER:-} && $SUDO_USER != root && $(stat -c %U .) == "$SUDO_USER" ]]; then
        exec sudo -H -u "$SUDO_USER" -- "$PWD/setup.sh" "$@"
    fi

    # rustup puts cargo there, and neither a fresh shell nor sudo may know it yet.
    has cargo || PATH="${HOME:-}/.cargo/bin:$PATH"
    if ! has cargo || ! has rustc; then
        die "cargo not found: install Rust as https://rustup.rs says, then run this again"
    fi
    link_shaderc
    say "ready"
}

main "$@"
