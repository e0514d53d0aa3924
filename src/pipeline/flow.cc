// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/pipeline/flow.h"

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "enfilade/base/file.h"
#include "enfilade/base/hash.h"
#include "enfilade/base/json.h"
#include "enfilade/exchange/colmap_writer.h"
#include "enfilade/exchange/connection_report.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/gltf_writer.h"
#include "enfilade/exchange/obj_writer.h"
#include "enfilade/exchange/plan_svg.h"
#include "enfilade/exchange/ply_writer.h"
#include "enfilade/exchange/point_cloud_reader.h"
#include "enfilade/exchange/scene_json.h"
#include "enfilade/exchange/transforms_writer.h"
#include "enfilade/floorplan/solve.h"
#include "enfilade/image/codec.h"
#include "enfilade/model/extrude.h"
#include "enfilade/model/texture.h"
#include "enfilade/pipeline/cloud.h"
#include "enfilade/pipeline/draw_plan.h"
#include "enfilade/pipeline/evidence_file.h"
#include "enfilade/pipeline/gather_evidence.h"
#include "enfilade/pipeline/label_file.h"
#include "enfilade/pipeline/pipeline.h"
#include "enfilade/pipeline/structure_file.h"
#include "enfilade/sfm/given_poses.h"
#include "enfilade/structure/analyze.h"
#include "src/pipeline/scene_hash.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;

StageResult NoResult(const std::string& reason) { return {StageOutcome::kNoResult, reason}; }

// Poses and points in the forms that other programs read.
void WriteForOthers(const Workspace& workspace, const Scene& scene) {
  const std::filesystem::path sparse = workspace.sparse_folder();
  WriteColmapModel(sparse / "panoramas", scene, ColmapForm::kEquirectangular,
                   ColmapEncoding::kBinary);
  WriteColmapModel(sparse / "rig", scene, ColmapForm::kPinholeRig, ColmapEncoding::kBinary);
  WriteColmapModel(sparse / "rig_text", scene, ColmapForm::kPinholeRig, ColmapEncoding::kText);
  WriteTransforms(sparse / "transforms.json", scene);
  WritePointsPly(workspace.points_file(), scene.points);
  WriteCamerasPly(sparse / "cameras.ply", scene.views);
}

// The rooms about panoramas as structure sees them. With its usual options: poses must not depend
// on those of a later stage.
std::vector<RoomOutline> FindOutlines(const Scene& scene, RunContext& context) {
  const Structure structure = AnalyzeStructure(scene, StructureOptions(), context).structure;
  std::vector<RoomOutline> outlines(scene.views.size());
  for (const WallProfile& profile : structure.profiles) {
    RoomOutline& outline = outlines[static_cast<size_t>(profile.view_idx)];
    outline.floor_z = profile.floor_z;
    outline.ceiling_z = profile.ceiling_z;
    outline.first_azimuth_rad = AzimuthOfColumn(0, profile.num_columns()) + structure.heading_rad;
    outline.wall_m = profile.wall_m;
  }
  return outlines;
}

// How bright each view of a film is, for whoever blends or compares their pictures.
void WriteExposures(const std::filesystem::path& path, const Scene& scene,
                    std::span<const double> exposures) {
  Json views = Json::array();
  for (size_t i = 0; i < exposures.size(); ++i) {
    const View& view = scene.views[i];
    views.push_back(
        {{"picture", view.picture}, {"sha256", view.sha256}, {"exposure", exposures[i]}});
  }
  WriteJsonFile(path,
                {{"format", "enfilade-exposure"}, {"version", 1}, {"views", std::move(views)}});
}

// Finds poses, or points and better ones for those that are given, as the options ask.
void PlaceViews(const Workspace& workspace, const PlaceOptions& options, RunContext& context,
                Scene& scene) {
  if (scene.pose_source == PoseSource::kEstimated) {
    const PlaceReport report = PlacePanoramas(
        options, {workspace.sfm_folder(), ProgramVersion(), FindOutlines}, context, scene);
    WriteConnectionReport(workspace.connections_folder(), scene,
                          {.pairs = report.registration.pairs,
                           .num_features = report.num_features,
                           .warnings = report.warnings});
    if (!report.exposures.empty())
      WriteExposures(workspace.exposure_file(), scene, report.exposures);
  } else {
    const GivenPoseReport report =
        FindPointsOfPoses(options, workspace.sfm_folder(), ProgramVersion(), context, scene);
    WriteConnectionReport(
        workspace.connections_folder(), scene,
        {.pairs = report.pairs, .num_features = report.num_features, .warnings = report.warnings});
  }
}

// The scene of an earlier run, with where pictures and masks lie now.
Scene ReadStandingScene(const Workspace& workspace, const Scene& read) {
  std::map<std::string, const View*> of_hash;
  for (const View& view : read.views) of_hash[view.sha256] = &view;
  Scene scene = ReadSceneJson(workspace.scene_file());
  for (View& view : scene.views) {
    const View& now = *of_hash.at(view.sha256);
    view.path = now.path;
    view.mask_path = now.mask_path;
  }
  return scene;
}

// Poses cost minutes, but where pictures and masks lie is no part of their key: a scene that stands
// is written again with the paths of now.
StageResult StoreScene(const Workspace& workspace, const Scene& read, const SfmOptions& options,
                       RunContext& context) {
  Scene scene = read;
  if (scene.pose_source != PoseSource::kEstimated &&
      !options.placing.scale.known_distance.empty()) {
    context.log().Warning("--known-distance is not used: the poses are given, with their scale");
  }
  if (options.placing.is_ordered && scene.pose_source != PoseSource::kEstimated) {
    context.log().Warning("poses are given, so that the order of the pictures is not used");
  }
  const bool is_costly = scene.pose_source == PoseSource::kEstimated ||
                         IsWorkOnGivenPoses(options.placing.given, scene);
  if (is_costly && std::filesystem::exists(workspace.scene_file())) {
    scene = ReadStandingScene(workspace, read);
  } else if (is_costly) {
    PlaceViews(workspace, options.placing, context, scene);
  }
  WriteForOthers(workspace, scene);
  WriteSceneJson(workspace.scene_file(), scene);
  return {};
}

// The label maps of panoramas, with a picture of each where the map is one of the picture's own
// pixels.
void WriteLabels(const Workspace& workspace, const Scene& scene,
                 const std::vector<Classification>& classifications, RunContext& context) {
  const std::filesystem::path folder = workspace.structure_folder();
  CreateFolder(folder);
  ParallelFor(context, "label maps", static_cast<int64_t>(classifications.size()), [&](int64_t i) {
    const auto view_idx = static_cast<size_t>(i);
    const View& view = scene.views[view_idx];
    const LabelMaps& maps = classifications[view_idx].maps;
    WriteLabelMaps(folder, static_cast<int>(i), maps);
    if (view.camera.model == CameraModel::kEquirectangular)
      WriteLabelPicture(folder, static_cast<int>(i), maps, ReadImageRgb(view.path));
  });
}

StageResult TakeCloud(const Workspace& workspace, const PipelineOptions& options,
                      RunContext& context) {
  if (options.points.file.empty()) return {};
  const Scene scene = ReadSceneJson(workspace.scene_file());
  WriteCloudFile(workspace.cloud_file(), ReadCloud(options.points, scene, context));
  return {};
}

// Of the files that hold the cloud: their paths are options, but what they hold counts.
std::string CloudHash(const CloudOptions& options) {
  if (options.file.empty()) return "";
  std::string hashes;
  for (const std::filesystem::path& path : FilesOfCloud(options.file, options.images))
    hashes += Sha256OfFile(path);
  return Sha256(hashes);
}

StageResult FindStructure(const Workspace& workspace, const PipelineOptions& options,
                          RunContext& context) {
  const Scene scene = ReadSceneWithPictures(workspace);
  const StructureReport report = AnalyzeStructure(scene, options.structure, context);
  WriteLabels(workspace, scene, report.classifications, context);
  WriteStructure(workspace.structure_folder(), report.structure);
  return {};
}

StageResult GatherEvidence(const Workspace& workspace, const PipelineOptions& options,
                           RunContext& context) {
  const Scene scene = ReadSceneOf(workspace);
  const Structure structure = ReadStructure(workspace.structure_folder());
  const GatheredEvidence gathered =
      EvidenceOf(scene, structure, options.evidence, EvidenceMode::kLogOdds, context);
  if (!gathered.reason.empty()) return NoResult(gathered.reason);
  WriteEvidence(workspace.evidence_folder(), gathered.storeys);
  return gathered.num_cores > 0 ? StageResult{}
                                : NoResult("no panorama stands in clear free space");
}

// What the plan came from: the version and the options of the stages up to here, as their records
// tell, without paths.
Json Provenance(const Workspace& workspace) {
  const Manifest manifest = ReadManifest(workspace.manifest_file());
  PipelineOptions options = OptionsOf(manifest);
  Json json = OptionsToJson(VisitorOf(options));
  for (const char* later_stage : {"model", "export"}) json.erase(later_stage);
  for (const char* path : {"poses", "mask"}) json["sfm"].erase(path);
  for (const char* path : {"file", "images"}) json["points"].erase(path);
  return {{"version", Version()}, {"seed", manifest.seed}, {"options", std::move(json)}};
}

StageResult DrawFloorplan(const Workspace& workspace, const PipelineOptions& options,
                          RunContext& context) {
  const FloorplanExplanation solved = SolveFromFiles(workspace, options.floorplan, context);
  const FloorplanReport& report = solved.report;
  if (report.outcome != FloorplanOutcome::kFound) return NoResult(report.reason);
  if (!report.reason.empty()) context.log().Warning(report.reason);
  StoreFloorplan(workspace, report.plan);
  return {};
}

StageResult BuildModel(const Workspace& workspace, const PipelineOptions& options,
                       RunContext& context) {
  const Scene scene = ReadSceneWithPictures(workspace);
  const Floorplan plan = ReadFloorplanJson(workspace.floorplan_file());
  const TextureResult textured =
      TextureModel(scene, plan, ExtrudeFloorplan(plan), options.model, context);
  WriteObj(workspace.model_obj_file(), textured.model);
  WriteGlb(workspace.model_glb_file(), textured.model, plan, Version());
  return {};
}

StageResult ExportPlan(const Workspace& workspace, const PipelineOptions& options,
                       RunContext& /*context*/) {
  WritePlanSvg(workspace.plan_svg_file(), ReadFloorplanJson(workspace.floorplan_file()),
               options.exporting.svg);
  return {};
}

}  // namespace

FloorplanExplanation SolveFromFiles(const Workspace& workspace, const FloorplanOptions& options,
                                    RunContext& context) {
  const bool is_paper = options.mode == FloorplanMode::kPaper;
  const Scene scene = is_paper ? ReadSceneOf(workspace) : ReadSceneWithPictures(workspace);
  const Structure structure = ReadStructure(workspace.structure_folder());
  FloorplanExplanation solved;
  if (is_paper) {
    // The paper's raw counts, with the options that the evidence of this run was made with.
    GatheredEvidence gathered =
        EvidenceOf(scene, structure, OptionsOf(ReadManifest(workspace.manifest_file())).evidence,
                   EvidenceModeOf(options.mode), context);
    if (!gathered.reason.empty()) {
      solved.report.reason = gathered.reason;
      return solved;
    }
    solved.evidence = std::move(gathered.storeys);
  } else {
    solved.evidence = ReadEvidence(workspace.evidence_folder());
  }
  solved.report = DrawPlan(scene, structure, solved.evidence, options, context);
  return solved;
}

void StoreFloorplan(const Workspace& workspace, const Floorplan& plan) {
  WriteFloorplanJson(workspace.floorplan_file(), plan, Provenance(workspace));
}

std::vector<Stage> MakeStages(const Workspace& workspace, const Scene* scene,
                              PipelineOptions& options) {
  using Body = StageResult (*)(const Workspace&, const PipelineOptions&, RunContext&);
  const auto run = [&workspace, &options](Body body) {
    return [&workspace, &options, body](RunContext& context) {
      return body(workspace, options, context);
    };
  };
  const auto store_scene = [&workspace, scene, &options](RunContext& context) {
    return StoreScene(workspace, *scene, options.sfm, context);
  };
  return {
      {"sfm",
       {"scene.json", "sparse", "points.ply", "connections", "exposure.json"},
       VisitorOf(options.sfm),
       scene != nullptr ? SceneHash(*scene) : "",
       store_scene,
       true},
      {"points",
       {"cloud.bin"},
       VisitorOf(options.points),
       CloudHash(options.points),
       run(TakeCloud)},
      {"structure", {"structure"}, VisitorOf(options.structure), "", run(FindStructure)},
      {"evidence", {"evidence"}, VisitorOf(options.evidence), "", run(GatherEvidence)},
      {"floorplan", {"floorplan.json"}, VisitorOf(options.floorplan), "", run(DrawFloorplan)},
      {"model",
       {"model.glb", "model.obj", "model.mtl", "textures"},
       VisitorOf(options.model),
       "",
       run(BuildModel)},
      {"export", {"plan.svg"}, VisitorOf(options.exporting), "", run(ExportPlan)},
  };
}

std::span<const std::string_view> StageNames() {
  static constexpr std::array<std::string_view, 7> kNames = {
      "sfm", "points", "structure", "evidence", "floorplan", "model", "export"};
  return kNames;
}

}  // namespace enfilade
