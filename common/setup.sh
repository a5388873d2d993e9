# setup.sh: what examples/run and tests/run do before their own work; sourced, not run. $self is the path
# of that script, links resolved.
#
#   setup_is_done NAME PACKAGE...     whether nothing has changed since the program NAME was built
#   setup NAME TARGETS PACKAGE...     installs, configures and builds what is missing or has changed
#
# Sets $root, the source tree, and $build, the build folder (LIGHTING_BUILD in the environment, or
# build/ in the source tree). Nothing here uses the network when nothing is missing.

root=$(CDPATH='' cd -- "${self%/*}/.." && pwd -P) || exit 1
build=${LIGHTING_BUILD:-$root/build}

# Debian's packages, by what needs them. To build and draw:
packages_to_draw="gcc libc6-dev pkg-config meson ninja-build libegl-dev libgles-dev libegl-mesa0 \
libgl1-mesa-dri libglfw3-dev libpng-dev libstb-dev fonts-dejavu-core"
# The panel in a window, model files, pictures other than PNG, animations other than GIF:
packages_to_window="g++ libimgui-dev"
packages_to_model="libassimp-dev"
packages_to_convert="g++ libopenimageio-dev"
packages_to_animate="ffmpeg"
# Vectors:
packages_to_diagram="libcairo2-dev fonts-liberation"
# accuracy and hard_cases: plots, and counts of operations.
packages_to_count="glslang-tools spirv-tools" # the operations of a shader
packages_to_study="gnuplot-nox glslang-tools spirv-tools"
# check: archives, JSON, the sandbox of a submission, and counts.
packages_to_check="libarchive-dev libjansson-dev libseccomp-dev zlib1g-dev bubblewrap glslang-tools \
spirv-tools"
packages_to_test="libcmocka-dev libosmesa6-dev python3 libwebpdemux2 xvfb xauth xdotool poppler-utils"
# What a release may not have; without it some tests are skipped. OSMesa left Mesa with 25.1.
packages_optional="libosmesa6-dev"

say() {
    printf '%s: %s\n' "${self#"$root"/}" "$*" >&2
}

# $build/.done-NAME is as old as the start of the last build of NAME, and holds the source tree's path
# and the packages that the build asked for. A newer file, or a folder from which one went, asks for
# another build; newer records of dpkg ask for another look at the packages.
setup_is_done() {
    stamp=$build/.done-$1
    case $1 in # may be built from a folder of -Dlabs, which is anywhere
    lab03_* | lab10_*) return 1 ;;
    esac
    [ -x "$build/examples/$1" ] && [ -f "$stamp" ] && ! [ /var/lib/dpkg/status -nt "$stamp" ] &&
        { read -r tree && read -r had; } <"$stamp" && [ "$tree" = "$root" ] || return 1
    shift
    for package; do
        case " $had " in
        *" $package "*) ;;
        *) return 1 ;;
        esac
    done
    [ -z "$(find "$root/meson.build" "$root/meson_options.txt" "$root/common" "$root/examples" \
        -newer "$stamp" -print -quit 2>&1)" ]
}

setup() {
    name=$1
    targets=$2
    shift 2
    setup_packages "$@"
    setup_lock
    printf '%s\n' "$root" "$*" >"$build/.begun"
    setup_configure
    setup_build
    mv -f "$build/.begun" "$build/.done-$name"
    exec 9>&-
}

setup_packages() {
    command -v dpkg-query >/dev/null || {
        hint="; it needs $(packages_elsewhere "$@")"
        command -v meson >/dev/null && return 0
        say "this is not a Debian system$hint"
        exit 1
    }
    missing=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$@" 2>/dev/null |
        awk -v wanted="$*" '$2 == "installed" { have[$1] = 1 }
            END { n = split(wanted, w, " "); for (i = 1; i <= n; i++) if (!(w[i] in have)) print w[i] }')
    [ -n "$missing" ] || return 0
    # shellcheck disable=SC2086
    missing=$(packages_of_this_release $missing)
    [ -n "$missing" ] || return 0
    # shellcheck disable=SC2086
    set -- $missing
    sudo=
    if [ "$(id -u)" != 0 ]; then
        sudo=sudo
        command -v sudo >/dev/null || {
            say "packages are missing, and this is neither root nor sudo; as root: apt-get install $*"
            exit 1
        }
    fi
    grep -q '^ID=debian$' /etc/os-release 2>/dev/null || say "untested on this system: only Debian is tested"
    say "installing with apt-get: $*"
    log=$(mktemp) || exit 1
    # The package lists are fetched only if they are missing or too old.
    # shellcheck disable=SC2046
    if ! install "$@" >"$log" 2>&1 &&
        ! { $sudo apt-get update >"$log" 2>&1 </dev/null &&
            install $(packages_of_this_release "$@") >>"$log" 2>&1; }; then
        tail -n 5 "$log" >&2
        rm -f "$log"
        say "apt-get could not install: $*"
        exit 1
    fi
    rm -f "$log"
}

# Those of the packages that there are, as far as the package lists say; where there are no lists,
# all of them.
packages_of_this_release() {
    for package; do
        case " $packages_optional " in
        *" $package "*)
            apt-cache show gcc >/dev/null 2>&1 && ! apt-cache show "$package" >/dev/null 2>&1 &&
                continue
            ;;
        esac
        printf '%s ' "$package"
    done
}

# What another system's package manager is to install instead of these packages of Debian.
packages_elsewhere() {
    column=2
    for words in "dnf install" "pacman -S" "apk add" "brew install"; do
        if command -v "${words%% *}" >/dev/null; then
            printf '%s%s (untested: only Debian is tested)' "$words" "$(
                awk -v column=$column -v wanted="$*" '
                    { name[$1] = $column }
                    END {
                        n = split(wanted, debian, " ")
                        for (i = 1; i <= n; i++) {
                            there = name[debian[i]]
                            if (there != "" && there != "-" && !said[there]++)
                                printf " %s", there
                        }
                    }' "$root/common/packages")"
            return
        fi
        column=$((column + 1))
    done
    printf 'what these packages of Debian contain: %s' "$*"
}

install() {
    $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" </dev/null
}

# Two calls must not build in one folder at once: the second waits. The children of a call that was
# killed keep the lock until they end.
setup_lock() {
    mkdir -p "$build" 2>/dev/null && { : >>"$build/.lock"; } 2>/dev/null || {
        say "cannot write to the build folder $build; LIGHTING_BUILD names another"
        exit 1
    }
    exec 9>>"$build/.lock"
    flock 9
}

# $build/.configured is as old as the configuration, which is done again if the tree was moved or
# packages were installed.
setup_configure() {
    stamp=$build/.configured
    if [ -f "$build/build.ninja" ]; then
        tree=$(sed -n 's/.*"source": "\([^"]*\)".*/\1/p' "$build/meson-info/meson-info.json" 2>/dev/null)
        if [ "${tree:-$root}" != "$root" ]; then
            [ -d "$tree" ] && {
                say "the build folder $build belongs to $tree; LIGHTING_BUILD names another"
                exit 1
            }
            rm -rf "$build"/meson-* "$build/build.ninja" # the tree was moved
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
    : >"$stamp"
}

# The first build of a target shows ninja's progress on a terminal; others say something if they fail.
setup_build() {
    if [ -f "$build/.done-$name" ]; then
        # shellcheck disable=SC2086
        output=$(ninja -C "$build" $targets 2>&1) && return
        printf '%s\n' "$output" >&2
    else
        say "building"
        if [ -t 2 ]; then
            # shellcheck disable=SC2086
            ninja -C "$build" $targets >&2 && return
        else
            # shellcheck disable=SC2086
            output=$(ninja -C "$build" $targets 2>&1) && return
            printf '%s\n' "$output" >&2
        fi
    fi
    say "the build failed${hint-}"
    exit 1
}
