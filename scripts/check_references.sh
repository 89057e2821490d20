#!/usr/bin/env bash
# Checks that every source named by a key like [Max1999] is listed in docs/references.md.
set -euo pipefail
cd "$(dirname "$0")/.."

status=0
for key in $(grep -rhoE '\[[A-Z][A-Za-z]+[0-9]{4}[a-z]?\]' talus apps docs README.md | sort -u); do
  if ! grep -qF -- "- **$key**" docs/references.md; then
    echo "$key is not in docs/references.md"
    status=1
  fi
done
exit $status
