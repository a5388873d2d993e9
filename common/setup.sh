# setup.sh: what examples/run and tests/run do before their own work; sourced, not run. $self is the path
# of that script, links resolved.
#
#   setup_is_done NAME PACKAGE...     whether nothing has changed since the program NAME was built
#   setup NAME TARGETS PACKAGE...     installs, configures and builds what is missing or has changed
#
# Sets $root, the source tree, and $build, the build folder: LIGHTING_BUILD in the environment, or
# build/ in the source tree; where that cannot be written and is not up to date, a folder in the user's
# cache. Nothing here uses the network when nothing is missing. $cross, if set, is the file of another
# machine, for which meson is to build: the browser's. $meson_options, if set, are for it; the build folder keeps them.

root=$(CDPATH='' cd -- "${self%/*}/.." && pwd -P) || exit 1
build=${LIGHTING_BUILD:-$root/build}
# Debian's emcc starts the first python3 in PATH for each file, which may be a version manager's: half a second.
[ -x /usr/bin/python3 ] && export EMSDK_PYTHON="${EMSDK_PYTHON:-/usr/bin/python3}"

# Debian's packages, by what needs them. To build and draw:
packages_to_draw="gcc libc6-dev pkg-config meson ninja-build libegl-dev libgles-dev libegl-mesa0 \
libgl1-mesa-dri libglfw3-dev libpng-dev libstb-dev fonts-dejavu-core"
# The panel in a window, model files, pictures other than PNG, animations:
packages_to_window="g++ libimgui-dev"
packages_to_model="libassimp-dev libjansson-dev"
packages_to_convert="g++ libopenimageio-dev"
packages_to_animate="ffmpeg"
# Vectors:
packages_to_diagram="libcairo2-dev fonts-liberation"
# precision: the truth.
packages_to_measure="libmpfr-dev gnuplot-nox"
# accuracy and hard_cases: plots.
packages_to_study="gnuplot-nox"
# check: archives, JSON, the sandbox of a submission.
packages_to_check="libarchive-dev libjansson-dev libseccomp-dev zlib1g-dev bubblewrap"
# The pages for a browser, and to test them.
packages_to_web="emscripten node-acorn node-qrcode-generator python3 fonttools pandoc meson ninja-build libjansson-dev libstb-dev fonts-dejavu-core"
packages_to_browse="chromium firefox-esr zbar-tools"
# The book as a PDF:
packages_to_print="chromium poppler-utils"
packages_to_test="libcmocka-dev libosmesa6-dev glslang-tools python3 libwebpdemux2 locales xvfb xauth xdotool \
poppler-utils"
# tests/run --long: what the pages show of several processes and machines.
packages_to_cluster="make munge parallel slurm-client slurmctld slurmd"
# tests/run, and its long form:
packages_of_tests="$packages_to_draw $packages_to_window $packages_to_model $packages_to_convert $packages_to_animate \
$packages_to_diagram $packages_to_study $packages_to_measure $packages_to_check $packages_to_test"
packages_of_long_tests="$packages_of_tests $packages_to_cluster $packages_to_web $packages_to_browse"
# What a release may not have; without it some tests are skipped. OSMesa left Mesa with 25.1.
packages_optional="libosmesa6-dev node-qrcode-generator zbar-tools $packages_to_cluster"

say() {
    printf '%s: %s\n' "${self#"$root"/}" "$*" >&2
}

# Ends with a status and a message, whose beginning is red on a terminal unless NO_COLOR is set
# (https://no-color.org).
fail() {
    status=$1
    shift
    if [ -t 2 ] && [ -z "${NO_COLOR-}" ] && [ "${TERM-dumb}" != dumb ]; then
        printf '\033[31m%s:\033[0m %s\n' "${self#"$root"/}" "$*" >&2
    else
        say "$@"
    fi
    exit "$status"
}

# Of the names on standard input the one that was probably meant by a word: the nearest, if at most a
# third of its letters differ, or the only one that begins so. Case does not count; of "lab05_phong"
# the first part is enough.
nearest() {
    awk -v word="$1" '
        function least(a, b) { return a < b ? a : b }
        function letter(text, i) { return substr(text, i, 1) }
        function distance(a, b, i, j, d) {
            for (i = 0; i <= length(a); i++) d[i, 0] = i
            for (j = 0; j <= length(b); j++) d[0, j] = j
            for (i = 1; i <= length(a); i++)
                for (j = 1; j <= length(b); j++) {
                    d[i, j] = d[i - 1, j - 1] + (letter(a, i) != letter(b, j))
                    d[i, j] = least(d[i, j], 1 + least(d[i - 1, j], d[i, j - 1]))
                    if (i > 1 && j > 1 && letter(a, i) == letter(b, j - 1) &&
                        letter(a, i - 1) == letter(b, j))
                        d[i, j] = least(d[i, j], 1 + d[i - 2, j - 2])
                }
            return d[length(a), length(b)]
        }
        BEGIN { word = tolower(word); min = length(word) / 3 + 0.1 }
        {
            name = part = tolower($0)
            sub(/_.*/, "", part)
            if (index(name, word) == 1 && beginnings++ == 0) beginning = $0
            d = least(distance(word, name), distance(word, part) + 0.05)
            if (d < min) { min = d; near = $0 }
        }
        END { print beginnings == 1 ? beginning : near }'
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
    # The pages have the shaders in them.
    [ -z "$(find "$root/meson.build" "$root/meson_options.txt" "$root/common" "$root/examples" \
        ${cross:+"$root/shaders"} -newer "$stamp" -print -quit 2>&1)" ]
}

# Whether ninja, which writes nothing then, finds nothing to do for TARGETS. Of a moved tree it would
# find nothing either.
setup_has_built() {
    [ "$(setup_tree)" = "$root" ] || return 1
    # shellcheck disable=SC2086
    case $(ninja -C "$build" -n $targets 2>&1) in
    *"no work to do"*) return 0 ;;
    esac
    return 1
}

setup_can_write() {
    # In a shell of its own, which a redirection that fails ends.
    mkdir -p "$build" 2>/dev/null && (: >>"$build/.lock") 2>/dev/null
}

# Where $root/build cannot be written: what is built there is run; all else is built in the user's
# cache, the tests always, because they write there. Returns whether nothing is to be done.
setup_elsewhere() {
    [ "${LIGHTING_BUILD-}" ] && return 1
    [ "$name" != all ] && setup_has_built && return 0
    case ${XDG_CACHE_HOME-} in
    /*) cache=$XDG_CACHE_HOME ;;
    *) cache=${HOME:+$HOME/.cache} ;;
    esac
    [ "$cache" ] || return 1
    shared=$build
    build=$cache/lighting/build-$(printf %s "$root" | cksum | sed 's/ .*//')${cross:+-web}
    setup_can_write || fail 1 "cannot write to the build folder $shared, nor to $build;" \
        "LIGHTING_BUILD names another"
    setup_is_done "$name" "$@" && return 0
    say "$shared cannot be written; building in $build"
    return 1
}

setup() {
    name=$1
    targets=$2
    shift 2
    if ! setup_can_write; then
        setup_elsewhere "$@" && return
    fi
    [ ! "$(setup_missing "$@")" ] || setup_lock # another call may be installing them
    setup_packages "$@"
    setup_lock
    printf '%s\n' "$root" "$*" >"$build/.begun"
    setup_configure
    setup_build
    mv -f "$build/.begun" "$build/.done-$name"
    exec 9>&-
}

# Those of the packages that are not installed.
setup_missing() {
    command -v dpkg-query >/dev/null || return
    dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$@" 2>/dev/null |
        awk -v wanted="$*" '$2 == "installed" { have[$1] = 1 }
            END { n = split(wanted, w, " "); for (i = 1; i <= n; i++) if (!(w[i] in have)) print w[i] }'
}

setup_packages() {
    command -v dpkg-query >/dev/null || {
        hint="; it needs $(packages_elsewhere "$@")"
        command -v meson >/dev/null && return 0
        fail 1 "this is not a Debian system$hint"
    }
    missing=$(setup_missing "$@")
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
            fail 1 "packages are missing, and this is neither root nor sudo; as root: apt-get install $*"
        }
    fi
    grep -q '^ID=debian$' /etc/os-release 2>/dev/null || say "untested on this system: only Debian is tested"
    log=$(mktemp) || exit 1
    # The package lists are fetched only if they are missing or too old. Another program that installs
    # packages, as a new desktop's updates do, has apt's locks: they are waited for.
    waits=
    # shellcheck disable=SC2046
    while ! install "$@" && ! { update && install $(packages_of_this_release "$@"); }; do
        if ! grep -q 'E: Could not get lock\|E: Unable to lock' "$log" || [ "${waits:-5}" = 0 ]; then
            tail -n 5 "$log" >&2
            rm -f "$log"
            fail 1 "apt-get could not install: $*"
        fi
        [ "$waits" ] || say "another program installs packages; waiting for it, at most 5 minutes"
        waits=$((${waits:-60} - 1))
        sleep 5
    done
    rm -f "$log"
}

update() {
    [ "$waits" ] || say "fetching the package lists"
    $sudo env LC_ALL=C apt-get update >>"$log" 2>&1 </dev/null 9>&-
}

# "160 MB to fetch, 650 MB on disk", as apt words it; nothing if it has no lists.
megabytes() {
    LC_ALL=C apt-get --print-uris -y --no-install-recommends install "$@" 2>/dev/null </dev/null |
        sed -n 's/^Need to get \(.*\) of archives.*/\1 to fetch/p
            s/^After this operation, \(.*\) of additional.*/, \1 on disk/p' | tr -d '\n'
}

# What apt does is seen on a terminal, in one line that it rewrites.
# (README.progress-reporting, of apt: "dlstatus:PACKAGE:PERCENT:TEXT", then "pmstatus:...")
install() {
    : >"$log"
    size=$(megabytes "$@")
    [ "$size" ] || return 1
    [ "$waits" ] || say "installing with apt-get ($size): $*"
    set -- apt-get install -y --no-install-recommends "$@"
    if [ -t 2 ]; then
        # sudo closes all but the standard streams.
        # shellcheck disable=SC2016
        code=$({ {
            $sudo env DEBIAN_FRONTEND=noninteractive LC_ALL=C sh -c '"$@" 3>&1 >&2' sh \
                "$@" -o APT::Status-Fd=3 2>>"$log" </dev/null 9>&-
            echo $? >&4
        } | while IFS=: read -r kind _ percent text; do
            case $kind in
            dlstatus | pmstatus) printf '\r\033[K%3d%% %.70s' "${percent%%.*}" "$text" >&2 ;;
            esac
        done; } 4>&1)
        printf '\r\033[K' >&2
        return "$code"
    fi
    $sudo env DEBIAN_FRONTEND=noninteractive LC_ALL=C "$@" >>"$log" 2>&1 </dev/null 9>&-
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

# Two calls must not install for one folder or build in it at once: the second waits. The children of a call
# that was killed keep the lock until they end, except apt-get's, which may be services.
setup_lock() {
    setup_can_write || {
        fail 1 "cannot write to the build folder $build; LIGHTING_BUILD names another"
    }
    exec 9>>"$build/.lock"
    flock -n 9 && return
    say "another command uses $build; waiting for it"
    flock 9
}

# The source tree that the build folder was configured for.
setup_tree() {
    cat "$build/source_root" 2>/dev/null
}

# Ends if meson, whose messages are in $log, found a file of the future.
fail_of_future() {
    future=$(sed -n 's/.*Clock skew detected. File \(.*\) has a time stamp .*/\1/p' "$log")
    [ "$future" ] || return 0
    rm -f "$log"
    fail 1 "$future is of the future: set the clock, or touch what is newer than now: find '$root' -newermt" \
        "now -exec touch {} +"
}

# $build/.configured is as old as the configuration, which is done again if the tree was moved or
# packages were installed, or, for the pages, which list them then, shaders came or went.
setup_configure() {
    stamp=$build/.configured
    if [ -f "$build/build.ninja" ]; then
        tree=$(setup_tree)
        if [ "${tree:-$root}" != "$root" ]; then
            [ -d "$tree" ] && [ "${build#"$root"/}" = "$build" ] && {
                fail 1 "the build folder $build belongs to $tree; LIGHTING_BUILD names another"
            }
            rm -rf "$build"/meson-* "$build/build.ninja" # the tree was moved or copied
        elif [ -f "$stamp" ] && ! [ /var/lib/dpkg/status -nt "$stamp" ] &&
            [ -z "${cross:+$(find "$root/shaders" -type d -newer "$stamp" -print -quit)}" ]; then
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
    if ! meson setup $again ${cross:+--cross-file "$cross"} ${meson_options-} "$build" "$root" >"$log" 2>&1; then
        fail_of_future
        tail -n 20 "$log" >&2
        rm -f "$log"
        fail 1 "meson could not configure $build"
    fi
    rm -f "$log"
    : >"$stamp"
}

# What ninja does and fails at, on standard error: the first build of a target on a terminal as it says it;
# otherwise, of a long build, each quarter and how far it is every 10 s, and everything only if it fails.
build_seen() {
    if [ "$first" ] && [ -t 2 ]; then
        ninja -C "$build" "$@" >&2
        return
    fi
    log=$(mktemp) || exit 1
    quarter=1
    said=$(date +%s)
    code=$({ {
        ninja -C "$build" "$@" 2>&1
        echo $? >&4
    } | tee "$log" | {
        while IFS='[/]' read -r _ built all _; do # [BUILT/ALL]; awk would read in blocks, and so later
            case $built$all in '' | *[!0-9]*) continue ;; esac
            now=$(date +%s)
            { [ "$all" -ge 40 ] && [ $((built * 4)) -ge $((all * quarter)) ] && [ $quarter -lt 4 ]; } ||
                { [ "$built" -lt "$all" ] && [ $((now - said)) -ge 10 ]; } || continue
            say "built $built of $all files"
            quarter=$((built * 4 / all + 1))
            said=$now
        done
    }; } 4>&1)
    [ "$code" = 0 ] || fail_of_future # ninja has started meson again
    [ "$code" = 0 ] || cat "$log" >&2
    rm -f "$log"
    return "$code"
}

setup_build() {
    first=
    [ -f "$build/.done-$name" ] || first=1
    [ ! "$first" ] || say "building $name"
    # shellcheck disable=SC2086
    build_seen $targets && return
    fail 1 "the build failed${hint-}"
}
