# setup.sh: what examples/run and tests/run do before their own work; sourced, not run. $self is the path
# of the script that does, with links followed.
#
#   setup_packages NAME...   installs those Debian packages that are missing, having said so
#   setup_lock               keeps a second call from building in the same folder at once
#   setup_configure          configures the build folder, unless that is done
#   setup_build TARGET       builds what is not up to date
#
# Sets $root, the source tree, and $build, the build folder (LIGHTING_BUILD in the environment, or
# build/ in the source tree). Nothing here uses the network when nothing is missing.

root=$(CDPATH='' cd -- "${self%/*}/.." && pwd -P) || exit 1
build=${LIGHTING_BUILD:-$root/build}

# To build and draw; the rest of what EGL needs at run time comes with these.
packages_to_draw="gcc g++ libc6-dev pkg-config meson ninja-build libegl-dev libgles-dev libegl1
    libegl-mesa0 libglfw3-dev libgl1-mesa-dri libpng-dev libopenimageio-dev libassimp-dev
    libimgui-dev fonts-dejavu-core libarchive-dev libjansson-dev libseccomp-dev
    zlib1g-dev"
# Of the programs in examples/study: plots, and counts of operations.
packages_to_study="gnuplot-nox glslang-tools spirv-tools"
# Of `check`: each submission of a class in a sandbox.
packages_to_labs="bubblewrap"
packages_to_test="libcmocka-dev libosmesa6-dev libcglm-dev libglm-dev python3
    ffmpeg libwebpdemux2 xvfb xauth xdotool"

say() {
    printf '%s: %s\n' "${self#"$root"/}" "$*" >&2
}

setup_packages() {
    command -v dpkg-query >/dev/null || {
        command -v meson >/dev/null && return 0
        say "this is not a Debian system; install what these packages hold, then run again: $*"
        exit 1
    }
    missing=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$@" 2>/dev/null |
        awk -v wanted="$*" '$2 == "installed" { have[$1] = 1 }
            END { n = split(wanted, w, " "); for (i = 1; i <= n; i++) if (!(w[i] in have)) print w[i] }')
    [ -n "$missing" ] || return 0
    # shellcheck disable=SC2086
    set -- $missing
    sudo=
    if [ "$(id -u)" != 0 ]; then
        sudo=sudo
        command -v sudo >/dev/null || {
            say "missing packages, and neither root nor sudo; as root run: apt-get install $*"
            exit 1
        }
    fi
    say "installing with apt-get: $*"
    log=$(mktemp) || exit 1
    # The lists of packages may be old or absent: fetch them only then.
    if ! $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" \
        >"$log" 2>&1 </dev/null &&
        ! { $sudo apt-get update >"$log" 2>&1 </dev/null &&
            $sudo env DEBIAN_FRONTEND=noninteractive \
                apt-get install -y --no-install-recommends "$@" >>"$log" 2>&1 </dev/null; }; then
        tail -n 5 "$log" >&2
        rm -f "$log"
        say "apt-get could not install: $*"
        exit 1
    fi
    rm -f "$log"
}

# One at a time: two calls must not build in one folder at once. Waits for the other. What a call that
# was killed left running keeps the lock until it ends.
setup_lock() {
    mkdir -p "$build" 2>/dev/null && { : >>"$build/.lock"; } 2>/dev/null || {
        say "cannot write to the build folder $build; LIGHTING_BUILD names another"
        exit 1
    }
    exec 9>>"$build/.lock"
    flock 9
}

# The stamp holds the source tree's path, and is as old as the configuration: a tree that was moved, and
# packages that came since, want a new one.
setup_configure() {
    stamp=$build/.configured
    if [ -f "$build/build.ninja" ]; then
        if [ "$(cat "$stamp" 2>/dev/null || printf '%s' "$root")" != "$root" ]; then
            rm -rf "$build"/meson-* "$build/build.ninja"
        elif [ -f "$stamp" ] && ! [ /var/lib/dpkg/status -nt "$stamp" ]; then
            return 0
        fi
    else
        rm -rf "$build/meson-private" "$build/meson-info" # of an interrupted configuration
    fi
    say "configuring $build"
    again=
    [ -f "$build/build.ninja" ] && again=--reconfigure
    log=$(mktemp) || exit 1
    # shellcheck disable=SC2086
    if ! meson setup $again "$build" "$root" >"$log" 2>&1; then
        tail -n 20 "$log" >&2
        rm -f "$log"
        say "meson could not configure $build"
        exit 1
    fi
    rm -f "$log"
    printf '%s' "$root" >"$stamp"
}

setup_build() {
    if ! [ -f "$build/.built-$1" ]; then
        say "building"
        if [ -t 2 ]; then # with ninja's own progress line
            ninja -C "$build" "$1" >&2 || {
                say "the build failed"
                exit 1
            }
        fi
    fi
    if ! output=$(ninja -C "$build" "$1" 2>&1); then
        printf '%s\n' "$output" >&2
        say "the build failed"
        exit 1
    fi
    : >"$build/.built-$1"
}
