#!/usr/bin/env bash
# Builds oneTBB from Debian's source with ThreadSanitizer, in build/tsan_tbb, for the preset tsan:
# the packaged library hides its synchronization, which gives hundreds of false reports.
set -euo pipefail
mkdir -p "$(dirname "$0")/../build/tsan_tbb"
cd "$(dirname "$0")/../build/tsan_tbb"
[[ ! -d installed ]] || exit 0

# Source packages are listed in a place of their own; the system's lists stay as they are.
mkdir -p apt/sources apt/lists/partial source
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
mirror=$(apt-get indextargets --format '$(REPO_URI)' "Codename: $suite" | sort -u | head -n 1)
cat > apt/sources/source.sources <<LIST
Types: deb-src
URIs: $mirror
Suites: $suite
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg
LIST
from_sources=(-q -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$PWD/apt/sources"
              -o "Dir::State::lists=$PWD/apt/lists")
apt-get "${from_sources[@]}" update
apt-get "${from_sources[@]}" source --download-only onetbb

tar xf onetbb_*.orig.tar.* -C source --strip-components=1
cmake -S source -B build -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_SANITIZE=thread \
  -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF -DCMAKE_INSTALL_PREFIX="$PWD/installing"
cmake --build build
cmake --install build
mv installing installed
