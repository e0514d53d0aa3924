#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Enfilade authors
# SPDX-License-Identifier: Apache-2.0
#
# Formats every C++ source of the repository in place, or checks that it is formatted:
#   scripts/format.sh           format
#   scripts/format.sh --check   change nothing, name the files that differ, exit 1 if there are any
#
# The format is that of clang-format 14 (Debian 12); other versions break lines elsewhere, so the
# script looks for that one. CLANG_FORMAT names another program.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if [[ $# -gt 1 || ( $# -eq 1 && $1 != --check ) ]]; then
  echo "usage: scripts/format.sh [--check]" >&2
  exit 2
fi

clang_format=${CLANG_FORMAT:-clang-format-14}
if ! command -v "$clang_format" >/dev/null; then
  echo "$clang_format: not found; install it with: apt-get install clang-format-14" >&2
  exit 2
fi

# Tracked files and new ones that git does not ignore, without those deleted but not yet committed.
files=()
while IFS= read -r -d '' file; do
  if [[ -f $file ]]; then files+=("$file"); fi
done < <(git ls-files -z --cached --others --exclude-standard -- '*.h' '*.cc' 2>/dev/null ||
         find apps include src tests -name '*.h' -print0 -o -name '*.cc' -print0)

if [[ ${1:-} != --check ]]; then
  "$clang_format" -i "${files[@]}"
  exit
fi

num_bad=0
for file in "${files[@]}"; do
  if ! "$clang_format" "$file" | cmp -s - "$file"; then
    echo "$file: not formatted; run scripts/format.sh" >&2
    num_bad=$((num_bad + 1))
  fi
done
echo "${#files[@]} files, $num_bad not formatted"
[[ $num_bad -eq 0 ]]
