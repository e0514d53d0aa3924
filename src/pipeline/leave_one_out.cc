// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/leave_one_out.h"

#include <algorithm>
#include <cstddef>

#include "enfilade/base/check.h"
#include "enfilade/pipeline/draw_plan.h"
#include "enfilade/structure/analyze.h"

namespace enfilade {
namespace {

constexpr int kMinOthers = 2;

// Takes a view out of a point's track and closes the gap that it leaves in the numbering.
void RemoveView(int view_idx, ScenePoint& point) {
  for (size_t k = point.view_idx.size(); k-- > 0;) {
    if (point.view_idx[k] != view_idx) continue;
    const auto place = static_cast<std::ptrdiff_t>(k);
    point.view_idx.erase(point.view_idx.begin() + place);
    if (!point.pixels.empty()) point.pixels.erase(point.pixels.begin() + place);
  }
  for (int& i : point.view_idx) i -= i > view_idx;
}

Scene SceneWithout(const Scene& scene, int view_idx) {
  Scene others = scene;
  others.views.erase(others.views.begin() + view_idx);
  std::erase_if(others.points, [&](const ScenePoint& point) {
    return point.view_idx.size() == 1 && point.view_idx.front() == view_idx;
  });
  for (ScenePoint& point : others.points) RemoveView(view_idx, point);
  return others;
}

}  // namespace

bool CanPlanWithout(const Scene& scene, int view_idx) {
  ENFILADE_CHECK(view_idx >= 0 && static_cast<size_t>(view_idx) < scene.views.size());
  const int storey_idx = scene.views[static_cast<size_t>(view_idx)].storey_idx;
  return std::count_if(scene.views.begin(), scene.views.end(), [&](const View& view) {
           return view.storey_idx == storey_idx;
         }) > kMinOthers;
}

Floorplan PlanWithout(const Scene& scene, int view_idx, const PipelineOptions& options,
                      RunContext& context) {
  ENFILADE_CHECK(CanPlanWithout(scene, view_idx));
  const Scene others = SceneWithout(scene, view_idx);
  const Structure structure = AnalyzeStructure(others, options.structure, context).structure;
  return PlanOf(others, structure, options, context);
}

}  // namespace enfilade
