#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Enfilade authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs what is missing, builds and tests:
#   scripts/test.sh [PRESET] [CTEST ARGUMENTS...]     PRESET: release (default), dev, asan, tsan
# Leaves out the tests with the label "slow" unless arguments are given. The last line is ctest's summary;
# the exit status is that of ctest.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${1:-release}
shift || true
arguments=("$@")
[[ ${#arguments[@]} -gt 0 ]] || arguments=(-LE slow)

scripts/install_deps.sh
cmake --preset "$preset"
cmake --build --preset "$preset"

log=build/$preset/ctest.log
status=0
ctest --preset "$preset" -j "$(nproc)" "${arguments[@]}" 2>&1 | tee "$log" || status=$?
grep -E '^[0-9]+% tests passed' "$log" || tail -n 1 "$log"
exit "$status"
