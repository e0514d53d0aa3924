// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/evaluate/moved_result.h"

namespace enfilade {

MovedResult::MovedResult(const EvaluationInput& input, const Rigid3& truth_from_world)
    : input_(input) {
  if (truth_from_world.Matrix().isIdentity(0)) return;
  const Rigid3 world_from_truth = truth_from_world.Inverse();
  if (input.scene != nullptr) {
    scene_.emplace();
    scene_->views = input.scene->views;
    for (View& view : scene_->views) view.world_from_cam = truth_from_world * view.world_from_cam;
    scene_->pose_source = input.scene->pose_source;
    scene_->scale_source = input.scene->scale_source;
    scene_->camera_height_m = input.scene->camera_height_m;
    input_.scene = &*scene_;
  }
  if (input.structure != nullptr) {
    structure_ = *input.structure;
    structure_->home_from_world = structure_->home_from_world * world_from_truth;
    input_.structure = &*structure_;
  }
  if (input.floorplan != nullptr) {
    floorplan_ = *input.floorplan;
    floorplan_->home_from_world = floorplan_->home_from_world * world_from_truth;
    for (PlanCamera& camera : floorplan_->cameras) {
      camera.world_from_cam = truth_from_world * camera.world_from_cam;
    }
    input_.floorplan = &*floorplan_;
  }
}

}  // namespace enfilade
