// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/compare.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "apps/enfilade/contest.h"
#include "apps/enfilade/label_maps.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "enfilade/evaluate/evaluate.h"
#include "enfilade/evaluate/model_view.h"
#include "enfilade/evaluate/regions.h"
#include "enfilade/exchange/floorplan_json.h"
#include "enfilade/exchange/obj_reader.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/image/resize.h"
#include "enfilade/pipeline/pipeline.h"
#include "enfilade/scene/virtual_view.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr int kViewQuality = 82;

// What models are looked at in: the true rooms, else the first plan, as high as the storeys; the
// cameras at least.
Eigen::AlignedBox3d ExtentOf(const ComparisonPage& page, const Structure& structure) {
  Eigen::AlignedBox2d plan;
  const auto include = [&](const Polygon2& polygon) {
    for (const Eigen::Vector2d& p : polygon.outer) plan.extend(p);
  };
  if (page.truth) std::for_each(page.truth->begin(), page.truth->end(), include);
  for (const ComparedMethod& method : page.methods) {
    if (!plan.isEmpty()) break;
    for (const Storey& storey : method.plan.storeys) {
      for (const Room& room : storey.rooms) include(room.polygon);
    }
  }
  for (const Eigen::Vector2d& camera : page.cameras) plan.extend(camera);
  Eigen::AlignedBox3d extent;
  for (const StoreyStructure& storey : structure.storeys) {
    extent.extend(Eigen::Vector3d(plan.min().x(), plan.min().y(), storey.floor_z));
    extent.extend(Eigen::Vector3d(plan.max().x(), plan.max().y(), storey.ceiling_z));
  }
  return extent;
}

std::string EncodeView(const ImageU8& image) { return EncodeImage(image, ".jpg", kViewQuality); }

// What the panorama shows where models are seen from inside.
std::string InsidePhoto(const View& view, const InsideView& inside, const Rigid3& home_from_world) {
  if (view.camera.model != CameraModel::kEquirectangular) return "";
  // As fine as the view, which has no low-pass filter.
  const int cols = 2 * static_cast<int>(kPi * inside.camera.fx);
  const ImageU8 panorama = ReduceImage(ReadImageRgb(view.path), cols / 2, cols);
  const Eigen::Matrix3d home_from_pano = home_from_world.rotation * view.world_from_cam.rotation;
  return EncodeView(RenderVirtualView(panorama, EquirectangularCamera(cols, cols / 2),
                                      inside.camera,
                                      home_from_pano.transpose() * inside.home_from_cam.rotation));
}

// The page before anything was tried. Refuses the truth of another home: that costs no minutes yet.
ComparisonPage StartPage(const Workspace& workspace, const Results& results,
                         const std::optional<GroundTruth>& truth, RunContext& context) {
  const Rigid3& home_from_world = results.structure->home_from_world;
  ComparisonPage page;
  page.title = PrintablePath(fs::weakly_canonical(workspace.root()).filename());
  page.num_panoramas = static_cast<int>(results.scene->views.size());
  for (const View& view : results.scene->views)
    page.cameras.emplace_back((home_from_world * view.world_from_cam.translation).head<2>());
  if (!truth) return page;
  EvaluationInput cameras;
  cameras.scene = &*results.scene;
  const EvaluationReport report = Evaluate(cameras, *truth, EvaluateOptions{}, context);
  page.truth = TrueRegion(*truth, home_from_world * report.truth_from_world.Inverse());
  return page;
}

// A contender's row, and the model that it left in its folder.
struct Examined {
  ComparedMethod method;
  BuildingModel model;
};

Examined Examine(const fs::path& folder, const Contender& contender, const ContestRecord& record,
                 const Results& results, const std::optional<GroundTruth>& truth,
                 RunContext& context) {
  Examined examined;
  ComparedMethod& method = examined.method;
  method.name = contender.name;
  method.title = contender.title;
  method.outcome = record.outcome;
  method.reason = record.reason;
  if (method.outcome == MethodOutcome::kFound) {
    method.plan = ReadFloorplanJson(folder / "floorplan.json");
    if (fs::exists(folder / "model.obj")) examined.model = ReadObj(folder / "model.obj");
    const size_t num_faces = examined.model.faces.size();
    if (truth) {
      // What is said of the pictures is the same for all.
      RunContext quiet(context.num_threads(), context.seed(), context.max_memory_mb());
      const JudgedResult judged =
          JudgePlan(results, method.plan, num_faces > 0 ? &examined.model : nullptr, *truth, quiet);
      WriteJudgement(folder, judged, *truth);
      method.figures = judged.report.figures;
    }
    AddSizes(method.plan, num_faces, method.figures);
  }
  method.figures["seconds"] = record.seconds;
  method.figures["peak_memory_mb"] = record.peak_memory_mb;
  return examined;
}

void DrawModels(const std::vector<BuildingModel>& models, const Structure& structure,
                const InsideView& inside, ComparisonPage& page, RunContext& context) {
  const int width_px = inside.camera.width;
  const Eigen::AlignedBox3d extent = ExtentOf(page, structure);
  for (size_t i = 0; i < models.size(); ++i) {
    if (models[i].faces.empty()) continue;
    ComparedMethod& method = page.methods[i];
    method.outside_jpeg = EncodeView(RenderFromOutside(models[i], extent, width_px, context));
    method.inside_jpeg = EncodeView(
        RenderFromInside(models[i], method.plan, inside.home_from_cam, inside.camera, context));
  }
}

// Photograph and label maps, or why there are none.
void AddPictures(const Workspace& workspace, const Manifest& manifest, Results& results,
                 const std::optional<GroundTruth>& truth, const InsideView& inside,
                 const OrientationMapOptions& options, ComparisonPage& page, RunContext& context) {
  page.inside_picture =
      PrintablePath(results.scene->views[static_cast<size_t>(inside.view_idx)].picture);
  try {
    results.scene = ReadSceneWithPictures(workspace);
  } catch (const UserError& error) {
    page.labels.reason = error.what();
    return;
  }
  page.inside_photo_jpeg = InsidePhoto(results.scene->views[static_cast<size_t>(inside.view_idx)],
                                       inside, results.structure->home_from_world);
  page.labels = CompareLabels(workspace, manifest, results, truth, options, context);
}

}  // namespace

ComparisonPage CompareMethods(const Workspace& workspace, const Manifest& manifest,
                              Results& results, const std::optional<GroundTruth>& truth,
                              const CompareOptions& options, RunContext& context) {
  ComparisonPage page = StartPage(workspace, results, truth, context);
  const std::vector<Contender> contenders = ContendersOf(manifest, options);
  const std::vector<ContestRecord> records =
      HoldContest(workspace, manifest, contenders, options, context);
  std::vector<BuildingModel> models;
  for (size_t i = 0; i < contenders.size(); ++i) {
    context.CheckStop();
    Examined examined = Examine(workspace.compare_folder() / contenders[i].name, contenders[i],
                                records[i], results, truth, context);
    page.methods.push_back(std::move(examined.method));
    models.push_back(std::move(examined.model));
  }
  const InsideView inside =
      ChooseInsideView(*results.scene, *results.structure, options.view_width);
  DrawModels(models, *results.structure, inside, page, context);
  AddPictures(workspace, manifest, results, truth, inside, options.orientation, page, context);
  nlohmann::json json = ComparisonToJson(page.methods);
  json["labels"] = LabelsToJson(page.labels);
  WriteJsonFile(workspace.compare_folder() / "comparison.json", json);
  WriteFileAtomic(workspace.compare_folder() / "comparison.html", FormatComparisonPage(page));
  return page;
}

}  // namespace enfilade
