# Sourced by the scripts beside it.
#
# LOOPCHECK_PRESET   the preset of CMakePresets.json to build: release (the default), ci, asan, ...
# Exit code 4        something could not be installed, configured or compiled.
set -Eeuo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
preset=${LOOPCHECK_PRESET:-release}
build=$root/build/$preset
report=$root/report
jobs=$(nproc)

build_packages=(g++ cmake ninja-build libosd-dev libopenmesh-dev libglm-dev libfmt-dev libexpected-dev libboost-dev
                nlohmann-json3-dev libcli11-dev zlib1g-dev libtbb-dev libgtest-dev libbenchmark-dev)
# npm bundles the page of --html.  A node that is no package of Debian's brings its own.
type -P npm >/dev/null || build_packages+=(nodejs npm)
test_packages=(clang-format python3 python3-jsonschema chromium parallel)

say() { printf '%s\n' "$*" >&2; }
stop() { say "$*"; exit 4; }

# install PACKAGE...: installs what is missing, on Debian; elsewhere CMake says what it cannot find.
install() {
    if ! type -P apt-get dpkg-query >/dev/null; then
        type -P cmake ninja >/dev/null || stop "loopcheck needs a C++20 compiler, CMake 3.25, Ninja and the" \
            "libraries of vcpkg.json; on Debian: apt-get install $*"
        return
    fi
    local package missing=() privileged=()
    for package; do
        [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] ||
            missing+=("$package")
    done
    ((${#missing[@]})) || return 0
    if ((EUID)); then
        type -P sudo >/dev/null || stop "As root: apt-get install ${missing[*]}"
        privileged=(sudo)
    fi
    say "Installing ${missing[*]}"
    "${privileged[@]}" apt-get update >&2
    "${privileged[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install --yes --no-install-recommends "${missing[@]}" >&2
}

# set_up TARGET PACKAGE...: installs the packages and builds the target, with nothing on standard output.
set_up() {
    trap 'stop "loopcheck could not be set up; the reason is above."' ERR
    install "${@:2}"
    cmake -S "$root" --preset "$preset" >/dev/null
    if [[ -t 2 ]]; then
        cmake --build "$build" --target "$1" >&2
    else
        cmake --build "$build" --target "$1" | sed -u '/^ninja: no work to do\.$/d' >&2
    fi
    trap - ERR
}
