#!/usr/bin/env bash
# Checks that the sources are formatted, short, and finished. Exits with 77 without clang-format 14.
set -euo pipefail
cd "$(dirname "$0")/.."

readonly kMaxLines=800
status=0

mapfile -t sources < <(find talus apps tests bench -name '*.h' -o -name '*.cpp' | sort)
mapfile -t scripts < <(find scripts tests bench talus -name '*.py' -o -name '*.sh' \
                            -o -name '*.mjs' -o -name '*.glsl' | sort)

for file in "${sources[@]}" "${scripts[@]}"; do
  lines=$(wc -l < "$file")
  if ((lines > kMaxLines)); then
    echo "$file: $lines lines; split it by subject, $kMaxLines is the most"
    status=1
  fi
done

# Marks of unfinished work; brackets keep this line from matching itself.
if grep -nE '\b(TO[D]O|FIX[M]E|XX[X]|HAC[K])\b|^#if [0]$' "${sources[@]}" "${scripts[@]}"; then
  echo "marks of unfinished work; finish it or leave it out"
  status=1
fi

if ! command -v clang-format-14 > /dev/null; then
  echo "clang-format-14 is missing: formatting not checked"
  exit $((status ? status : 77))
fi
for file in "${sources[@]}"; do
  if ! clang-format-14 --dry-run -Werror "$file" 2> /dev/null; then
    echo "$file: not formatted; run clang-format-14 -i $file"
    status=1
  fi
done
exit $status
