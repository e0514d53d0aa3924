// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "apps/enfilade/arguments.h"
#include "apps/enfilade/command.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/wall_report.h"
#include "enfilade/floorplan/explain_wall.h"
#include "enfilade/floorplan/wall_crops.h"
#include "enfilade/image/codec.h"
#include "enfilade/pipeline/evidence_file.h"
#include "enfilade/pipeline/pipeline.h"
#include "enfilade/pipeline/structure_file.h"

namespace enfilade {
namespace {

struct Arguments {
  std::string output;
  int wall_id = 0;
  int storey_id = 0;
};

void RequirePlan(const Workspace& workspace, const Manifest& manifest) {
  const StageRecord* record = manifest.Find("floorplan");
  if (record != nullptr && record->outcome == StageOutcome::kDone) return;
  throw InvalidInputError(workspace.root().native(), "holds no plan whose walls could be explained",
                          "run 'enfilade run' or 'enfilade floorplan' first");
}

size_t FindStorey(const Floorplan& plan, int storey_id) {
  std::string known;
  for (size_t i = 0; i < plan.storeys.size(); ++i) {
    if (plan.storeys[i].id == storey_id) return i;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", plan.storeys[i].id);
  }
  throw InvalidInputError("--storey", fmt::format("the plan has no storey {}", storey_id),
                          fmt::format("it has {}", known));
}

size_t FindWall(const Storey& storey, int wall_id) {
  const std::vector<Wall>& walls = storey.walls;
  if (walls.empty()) {
    throw InvalidInputError("WALL", fmt::format("storey {} has no walls", storey.id),
                            "choose another with --storey");
  }
  const auto nearest =
      std::min_element(walls.begin(), walls.end(), [&](const Wall& a, const Wall& b) {
        return std::abs(a.id - wall_id) < std::abs(b.id - wall_id);
      });
  if (nearest->id != wall_id) {
    throw InvalidInputError(
        "WALL", fmt::format("storey {} has no wall {}", storey.id, wall_id),
        fmt::format("the nearest is {}; ids stand in plan.svg and floorplan.json", nearest->id));
  }
  return static_cast<size_t>(nearest - walls.begin());
}

int Explain(const Arguments& arguments) {
  const Workspace workspace(arguments.output);
  const WorkspaceLock lock(workspace, WorkspaceUse::kExisting);
  const Manifest manifest = ReadManifest(workspace.manifest_file());
  RequirePlan(workspace, manifest);
  const Floorplan plan = ReadFloorplanJson(workspace.floorplan_file());
  const size_t storey_idx = FindStorey(plan, arguments.storey_id);
  const Storey& storey = plan.storeys[storey_idx];
  const size_t wall_idx = FindWall(storey, arguments.wall_id);
  const Scene scene = ReadSceneWithPictures(workspace);
  const WallExplanation why =
      ExplainWall(scene, ReadStructure(workspace.structure_folder()),
                  ReadEvidence(workspace.evidence_folder()).at(storey_idx),
                  OptionsOf(manifest).floorplan, plan, static_cast<int>(storey_idx), wall_idx);
  WriteFileAtomic(workspace.wall_svg_file(storey.id, why.wall.id), FormatWallSvg(plan, scene, why));
  const auto room = std::find_if(storey.rooms.begin(), storey.rooms.end(),
                                 [&](const Room& r) { return r.id == why.wall.room_id; });
  WriteImage(workspace.wall_png_file(storey.id, why.wall.id),
             DrawWallCrops(scene, plan.home_from_world, *room, why.wall, why.witnesses));
  std::fputs(FormatWallReport(scene, why).c_str(), stdout);
  std::fputs(fmt::format("drawn in {} and, the pictures in the order above, {}\n",
                         workspace.wall_svg_file(storey.id, why.wall.id).filename().native(),
                         workspace.wall_png_file(storey.id, why.wall.id).filename().native())
                 .c_str(),
             stdout);
  return kExitOk;
}

}  // namespace

Action SetupWhy(CLI::App& parser) {
  const auto arguments = std::make_shared<Arguments>();
  parser.add_option("OUT", arguments->output, "Result folder with a plan")->required();
  parser.add_option("WALL", arguments->wall_id, "The wall's id in floorplan.json")->required();
  parser.add_option("--storey", arguments->storey_id, "Id of the storey that the wall is on");
  return [arguments] { return Explain(*arguments); };
}

}  // namespace enfilade
