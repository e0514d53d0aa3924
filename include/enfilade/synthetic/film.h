// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "enfilade/synthetic/home.h"

namespace enfilade {

/// The home with one camera for each frame of a film instead of its own ones. The film follows a
/// smooth curve past the home's cameras (a uniform cubic B-spline of positions and headings, within
/// 0.2 m of every camera) at 0.8 m/s, slower where it would turn by more than 90° a second.
/// Pictures are called frame_000000.jpg and so on.
///
/// Throws InvalidInputError where the cameras lean or do not follow a path: fewer than two, or one
/// more than 1 m from the one before.
[[nodiscard]] Home FilmWalk(const Home& walk, double frames_per_second);

}  // namespace enfilade
