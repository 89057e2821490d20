#!/usr/bin/env bash
# Installs the Debian packages that Talus needs; does nothing where all of them are there.
#
#   scripts/setup.sh [run|test]    run: to build and use the tool (default); test: its tests too
set -euo pipefail

readonly kRunPackages=(
  ccache cmake g++ mold ninja-build pkgconf
  libassimp-dev libcli11-dev libfmt-dev libgdal-dev libglm-dev libopenexr-dev libpng-dev libtbb-dev
  libtomlplusplus-dev libxxhash-dev nlohmann-json3-dev
  libegl-dev libegl-mesa0 libepoxy-dev libgl1-mesa-dri
)
readonly kTestPackages=(
  clang-format-14 libbenchmark-dev libboost-dev libgtest-dev librapidcheck-dev python3
  blender fish gdal-bin groff-base python3-numpy zsh
)

level=${1:-run}
case $level in
  run) wanted=("${kRunPackages[@]}") ;;
  test)
    wanted=("${kRunPackages[@]}" "${kTestPackages[@]}")
    # A node from elsewhere comes with its own npm and cannot stand beside Debian's.
    command -v npm > /dev/null || wanted+=(nodejs npm)
    ;;
  *)
    echo "setup.sh: unknown level \"$level\"; give run or test" >&2
    exit 2
    ;;
esac

if ! command -v apt-get > /dev/null; then
  echo "setup.sh: not a Debian system: nothing installed. Please provide what these Debian 12" \
       "packages hold: ${wanted[*]}" >&2
  exit 0
fi

# Packages that dpkg does not list as installed.
installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2> /dev/null || true)
missing=()
for package in "${wanted[@]}"; do
  [[ $'\n'$installed$'\n' == *$'\n'"installed $package"$'\n'* ]] || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo > /dev/null; then
    echo "setup.sh: packages are missing and there is no sudo; as root, run:" \
         "apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing ${#missing[@]} packages with ${as_root[*]:+sudo }apt-get: ${missing[*]}"
as_root+=(env DEBIAN_FRONTEND=noninteractive TZ=Etc/UTC)
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! {
  "${as_root[@]}" apt-get update -q -o DPkg::Lock::Timeout=600 &&
    "${as_root[@]}" apt-get install -q -y --no-install-recommends -o DPkg::Lock::Timeout=600 \
      "${missing[@]}"
} > "$log" 2>&1 < /dev/null; then
  cat "$log" >&2
  echo "setup.sh: the installation failed; see above" >&2
  exit 1
fi
