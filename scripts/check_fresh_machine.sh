#!/usr/bin/env bash
# Runs ./demo, ./demo again and ./test in a bare Debian 12 that has only git and ca-certificates.
#
#   scripts/check_fresh_machine.sh [FOLDER]
#
# Needs root and debootstrap. The system and a log of each step are kept in FOLDER, which must not
# exist; without FOLDER nothing is kept. What is committed here is cloned there; mirror, proxies,
# certificates and npm settings are this machine's own.
set -euo pipefail

repository=$(cd "$(dirname "$0")/.." && pwd)
if [[ $# -gt 0 ]]; then
  mkdir "$1"
  folder=$(cd "$1" && pwd)
else
  folder=$(mktemp -d)
fi
root=$folder/root

finish() {
  for place in dev sys proc; do
    ! mountpoint -q "$root/$place" || umount --lazy "$root/$place"
  done
  [[ $1 == keep ]] || rm -rf --one-file-system "$folder"
}
trap 'finish "$([[ $# -gt 0 ]] && echo keep || echo remove)"' EXIT

# step NAME COMMAND...: runs a command and says how long it took.
step() {
  local name=$1 start=$SECONDS status
  shift
  set +e
  (set -e && "$@") > "$folder/$name.log" 2>&1 < /dev/null
  status=$?
  set -e
  echo "$name: $((SECONDS - start)) s"
  if ((status)); then
    tail -n 40 "$folder/$name.log"
    echo "$name failed with exit status $status"
    exit 1
  fi
}

in_root() {
  env -i HOME=/srv PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
    ${NODE_EXTRA_CA_CERTS:+NODE_EXTRA_CA_CERTS=/etc/ssl/certs/ca-certificates.crt} \
    chroot "$root" "$@"
}

make_system() {
  local mirror
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Codename: bookworm' | sort -u | head -n 1)
  debootstrap --variant=minbase --include=git,ca-certificates bookworm "$root" ${mirror:+"$mirror"}
  for place in proc sys dev; do
    mount --bind "/$place" "$root/$place"
  done
}

copy_network_settings() {
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
  apt-config dump Acquire > "$root/etc/apt/apt.conf.d/99network"
  cp -a /usr/local/share/ca-certificates/. "$root/usr/local/share/ca-certificates/"
  in_root update-ca-certificates
  [[ ! -f $HOME/.npmrc ]] || cp "$HOME/.npmrc" "$root/srv/"
}

clone() {
  git -C "$repository" bundle create "$root/srv/talus.bundle" HEAD
  in_root git clone /srv/talus.bundle /srv/talus
}

step debootstrap make_system
step network copy_network_settings
step clone clone
step setup in_root /srv/talus/scripts/setup.sh run
step demo in_root /srv/talus/demo
step demo_again in_root /srv/talus/demo
step setup_tests in_root /srv/talus/scripts/setup.sh test
step test in_root /srv/talus/test
tail -n 12 "$folder/test.log"
