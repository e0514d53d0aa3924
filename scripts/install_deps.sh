#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Enfilade authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs what the build needs from Debian 12 or Ubuntu 24.04 packages, as root or through sudo.
# What is there already is left alone; with everything there it does nothing and needs no root.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config python3
  libeigen3-dev libfmt-dev libspdlog-dev nlohmann-json3-dev libssl-dev
  libopencv-dev libcgal-dev libboost-dev libceres-dev libgeos-dev libpugixml-dev libembree-dev
  libcli11-dev libtinygltf-dev libcairo2-dev libsqlite3-dev libglpk-dev
  libgtest-dev libgmock-dev libbenchmark-dev
)

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Abbrev}' "$package" 2>/dev/null || true)
  [[ $status == ii* ]] || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  echo "all dependencies are installed"
  exit 0
fi

if ! command -v apt-get >/dev/null; then
  echo "this script needs apt-get; install by other means: ${missing[*]}" >&2
  exit 1
fi
as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "run this script as root to install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "installing: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -q
"${as_root[@]}" apt-get install -q -y --no-install-recommends "${missing[@]}"
