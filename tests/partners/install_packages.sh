#!/bin/sh
# Installs the pinned npm packages into FOLDER, once.
here=$(dirname "$0")
if ! command -v npm >/dev/null; then
  echo "skipped: npm is not installed"
  exit 77
fi
if cmp -s "$here/package-lock.json" "$1/node_modules/.installed"; then
  exit 0
fi
mkdir -p "$1" && cp "$here/package.json" "$here/package-lock.json" "$1" || exit 1
if ! npm ci --prefix "$1" --no-audit --no-fund; then
  echo "skipped: npm could not fetch the packages"
  rm -rf "$1/node_modules"
  exit 77
fi
cp "$here/package-lock.json" "$1/node_modules/.installed"
