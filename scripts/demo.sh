#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Enfilade authors
# SPDX-License-Identifier: Apache-2.0
#
# The whole way on a home of our own: installs what is missing, builds, makes a furnished three-room
# home with its panoramas, reconstructs it and judges the result. Needs no data. Run it again and
# it takes up where it was.
#   scripts/demo.sh [FOLDER]     FOLDER: out/demo unless given
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

folder=${1:-out/demo}
scripts/install_deps.sh
cmake --preset release
cmake --build --preset release --target enfilade
enfilade=build/release/bin/enfilade

"$enfilade" synth --home.rooms 3 -o "$folder/home"
"$enfilade" run "$folder/home" -o "$folder/result"
"$enfilade" evaluate "$folder/result" --truth "$folder/home"

cat <<END

panoramas  $folder/home/panos
plan       $folder/result/plan.svg
model      $folder/result/model.glb
numbers    $folder/result/floorplan.json
score      $folder/result/evaluation.json
overlay    $folder/result/overlay.png
END
