// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/synthetic/furniture.h"

namespace enfilade {

// What is fixed to the walls of lived-in homes, and what movers leave against them. Sizes in
// metres; heights count from the floor. Colours come from `random`, sizes from whoever fits the
// piece in.

/// A panel radiator on its brackets: 10 cm from the wall to its front.
[[nodiscard]] FurniturePiece Radiator(double width_m, double top_m);

/// A ladder of heated bars for towels.
[[nodiscard]] FurniturePiece TowelRadiator();

/// A curtain in folds from just below `top_m` to just above the floor.
[[nodiscard]] FurniturePiece Curtain(double width_m, double top_m, const Eigen::Vector3f& rgb,
                                     Random& random);

/// The rod that curtains hang on.
[[nodiscard]] FurniturePiece CurtainRod(double width_m, double top_m);

/// A wardrobe with hinged or sliding doors, 60 cm deep.
[[nodiscard]] FurniturePiece FittedWardrobe(double width_m, double top_m, Random& random);

/// A narrow cupboard for brooms, coats or food.
[[nodiscard]] FurniturePiece TallCupboard(const Eigen::Vector2d& footprint, double top_m,
                                          Random& random);

/// A shower tray behind panes of milk glass, 2 m high.
[[nodiscard]] FurniturePiece ShowerCabin(Random& random);

/// Open shelves on cupboards, nearly empty.
[[nodiscard]] FurniturePiece FittedShelves(double width_m, double top_m, Random& random);

/// A box under the ceiling that hides pipes or a beam.
[[nodiscard]] FurniturePiece Bulkhead(const Eigen::Vector2d& footprint, double low_m, double top_m,
                                      const Eigen::Vector3f& rgb);

/// Cardboard boxes side by side, one to three high.
[[nodiscard]] FurniturePiece MovingBoxes(Random& random);

/// A board on brackets with a few things on it.
[[nodiscard]] FurniturePiece WallShelf(Random& random);

/// A framed picture.
[[nodiscard]] FurniturePiece Picture(Random& random);

/// Where a picture hung, the paint differs from the rest of its wall by a few hundredths.
[[nodiscard]] FurniturePiece PaintPatch(const HomeRoom& room, Random& random);

/// A plate of about 8 × 12 cm.
[[nodiscard]] FurniturePiece Socket();
[[nodiscard]] FurniturePiece LightSwitch();
[[nodiscard]] FurniturePiece Thermostat();

/// The slats of an air duct, from `low_m` up.
[[nodiscard]] FurniturePiece Grille(const Eigen::Vector2d& size, double low_m);

}  // namespace enfilade
