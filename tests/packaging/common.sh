# Shared by the tests of packaging. Each is called with SOURCE BUILD COMPILER.
set -euo pipefail
name=$(basename "$0")
source=$1 build=$2 compiler=$3
fail() { echo "$name: $*" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

install_abut() {
    cmake --install "$build" --prefix "$work/prefix" >"$work/install.log" ||
        fail "cmake --install: $(cat "$work/install.log")"
    mv "$work/prefix" "$work/moved" # an installed folder may be moved
    prefix=$work/moved
}

# A program of the library, and one that draws.
write_programs() {
    cat >"$work/apart.cpp" <<'CPP'
#include <abut/abut.h>
#include <cstdio>

int main() {
    const std::vector<double> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::vector<std::uint32_t> faces{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
    const abut::Model model(abut::make_mesh(corners, faces));
    try {
        abut::read_mesh("missing.stl");
    } catch (const abut::Error& error) {
        std::printf("%g %s\n", abut::distance(model, {}, model, abut::Pose{.translation = {3, 0, 0}}).distance,
                    error.what());
    }
}
CPP
    cat >"$work/draw.cpp" <<'CPP'
#include <abut/error.h>
#include <abut/picture.h>
#include <cstdio>
#include <vector>

int main() {
    try {
        abut::picture(std::vector<abut::Scene>{}, abut::PictureOptions{.width = 0});
    } catch (const abut::Error& error) {
        std::printf("%s\n", error.what());
    }
}
CPP
}

check_apart() {
    local said
    said=$("$1") || fail "$1 ends with status $?"
    [[ $said == "2 missing.stl: "* ]] || fail "$1 said: $said"
}

check_draw() {
    local said
    said=$("$1") || fail "$1 ends with status $?"
    [[ -n $said ]] || fail "$1 said nothing"
}
