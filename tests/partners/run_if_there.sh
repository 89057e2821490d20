#!/bin/sh
# Runs a command, or skips the test where the program or a package of it is absent.
if ! command -v "$1" >/dev/null; then
  echo "skipped: $1 is not installed"
  exit 77
fi
case "$1" in
  node)
    if [ ! -d "$(dirname "$2")/node_modules" ]; then
      echo "skipped: the npm packages could not be installed"
      exit 77
    fi
    ;;
esac
exec "$@"
