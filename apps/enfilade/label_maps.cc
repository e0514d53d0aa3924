// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/label_maps.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/enfilade/contest.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/hash.h"
#include "enfilade/base/json.h"
#include "enfilade/evaluate/labels.h"
#include "enfilade/evaluate/picture_matching.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/image/resize.h"
#include "enfilade/pipeline/label_file.h"
#include "enfilade/pipeline/pipeline.h"
#include "enfilade/pipeline/stage.h"
#include "enfilade/structure/analyze.h"
#include "enfilade/structure/label_tint.h"
#include "enfilade/structure/level_panorama.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr int kThumbWidth_px = 400;
constexpr int kThumbQuality = 72;

// Every pixel without a label takes that of the nearest pixel of its column which has one.
ImageU8 CompletedByColumn(const ImageU8& labels) {
  ImageU8 completed = labels;
  for (int c = 0; c < labels.cols(); ++c) {
    std::vector<int> defined;
    for (int r = 0; r < labels.rows(); ++r) {
      if (labels(r, c) != 0) defined.push_back(r);
    }
    if (defined.empty()) continue;
    size_t k = 0;
    for (int r = 0; r < labels.rows(); ++r) {
      while (k + 1 < defined.size() && defined[k + 1] - r <= r - defined[k]) ++k;
      completed(r, c) = labels(defined[k], c);
    }
  }
  return completed;
}

// Makes a folder of maps, unless it was made with the same key before.
template <typename Make>
void KeepFolder(const Workspace& workspace, const fs::path& folder, const std::string& key,
                const Make& make) {
  const fs::path key_file = folder / "key.json";
  if (StoredKey(key_file) == key) return;
  RemoveFiles(workspace, {folder.lexically_relative(workspace.root())});
  CreateFolder(folder);
  make();
  WriteJsonFile(key_file, {{"key", key}});
}

// The folder with the maps of the classification.
fs::path ClassifiedFolder(const Workspace& workspace, const Manifest& manifest,
                          const Results& results, RunContext& context) {
  StructureOptions options = OptionsOf(manifest).structure;
  if (options.mode != StructureMode::kProfile) return workspace.structure_folder();
  options.mode = StructureMode::kPaper;
  fs::path folder = workspace.compare_folder() / "labels";
  const std::string key = Sha256(ProgramVersion() + manifest.Find("structure")->key);
  KeepFolder(workspace, folder, key, [&] {
    const StructureReport report = AnalyzeStructure(*results.scene, options, context);
    for (size_t i = 0; i < report.classifications.size(); ++i)
      WriteLabelMaps(folder, static_cast<int>(i), report.classifications[i].maps);
  });
  return folder;
}

fs::path OrientationFolder(const Workspace& workspace, const Manifest& manifest,
                           const Results& results, const OrientationMapOptions& options,
                           RunContext& context) {
  const Scene& scene = *results.scene;
  const Rigid3& home_from_world = results.structure->home_from_world;
  fs::path folder = workspace.compare_folder() / "orientation";
  OrientationMapOptions named = options;
  const std::string key = Sha256(ProgramVersion() + manifest.Find("structure")->key +
                                 OptionsToJson(VisitorOf(named)).dump());
  const auto make_one = [&](int64_t i) {
    const View& view = scene.views[static_cast<size_t>(i)];
    if (!IsPanorama(view)) return;
    const LevelPanorama panorama = MakeLevelPanorama(
        view, ReadImageRgb(view.path), home_from_world, LevelWidth(view, options.width),
        DegToRad(StructureOptions().stand_elevation_deg));
    const ImageU8 labels = MapOrientations(panorama.rgb, options).labels;
    const LabelMaps level{ImageU8(labels.rows(), labels.cols()), CompletedByColumn(labels), labels};
    WriteLabelMaps(folder, static_cast<int>(i),
                   MapsInCamera(level, home_from_world.rotation * view.world_from_cam.rotation));
  };
  KeepFolder(workspace, folder, key, [&] {
    ParallelFor(context, "orientation maps", static_cast<int64_t>(scene.views.size()), make_one);
  });
  return folder;
}

std::string Thumb(const ImageU8& picture) {
  return EncodeImage(ReduceImage(picture, kThumbWidth_px / 2, kThumbWidth_px), ".jpg",
                     kThumbQuality);
}

LabelSheet SheetOf(const View& view, int view_idx, const fs::path& classified,
                   const fs::path& orientation) {
  const ImageU8 picture = ReadImageRgb(view.path);
  LabelSheet sheet;
  sheet.picture = PrintablePath(view.picture);
  sheet.photo_jpeg = Thumb(picture);
  const auto tinted = [&](const ImageU8& map) { return Thumb(TintByLabels(picture, map)); };
  if (const std::optional<LabelMaps> maps = ReadLabelMaps(classified, view_idx)) {
    sheet.points_jpeg = tinted(maps->after_points);
    sheet.free_space_jpeg = tinted(maps->after_free_space);
    sheet.final_jpeg = tinted(maps->final_labels);
  }
  if (const std::optional<LabelMaps> maps = ReadLabelMaps(orientation, view_idx))
    sheet.orientation_jpeg = tinted(maps->final_labels);
  return sheet;
}

void Judge(const Results& results, const GroundTruth& truth, const fs::path& classified,
           const fs::path& orientation, ComparedLabels& labels, RunContext& context) {
  const std::vector<int> truth_idx = MatchPictures(PictureKeys(*results.scene), PictureKeys(truth));
  const auto judge = [&](const fs::path& maps) {
    return EvaluateLabels(
        *results.scene, *results.structure, truth, truth_idx,
        [&](int view_idx) { return ReadLabelMaps(maps, view_idx); }, context);
  };
  const LabelFigures own = judge(classified), rival = judge(orientation);
  labels.points = own.points_accuracy;
  labels.free_space = own.free_space_accuracy;
  labels.superpixels = own.superpixel_accuracy;
  labels.profiles = own.accuracy;
  labels.orientation = rival.superpixel_accuracy;
  labels.orientation_completed = rival.free_space_accuracy;
}

}  // namespace

ComparedLabels CompareLabels(const Workspace& workspace, const Manifest& manifest,
                             const Results& results, const std::optional<GroundTruth>& truth,
                             const OrientationMapOptions& options, RunContext& context) {
  const fs::path classified = ClassifiedFolder(workspace, manifest, results, context);
  const fs::path orientation = OrientationFolder(workspace, manifest, results, options, context);
  ComparedLabels labels;
  if (truth) Judge(results, *truth, classified, orientation, labels, context);
  std::vector<int> panoramas;
  for (size_t i = 0; i < results.scene->views.size(); ++i) {
    if (IsPanorama(results.scene->views[i])) panoramas.push_back(static_cast<int>(i));
  }
  const auto name_of = [&](int view_idx) {
    return results.scene->views[static_cast<size_t>(view_idx)].picture;
  };
  std::stable_sort(panoramas.begin(), panoramas.end(),
                   [&](int a, int b) { return name_of(a) < name_of(b); });
  labels.sheets.resize(panoramas.size());
  ParallelFor(context, "label pictures", static_cast<int64_t>(panoramas.size()), [&](int64_t i) {
    const int view_idx = panoramas[static_cast<size_t>(i)];
    labels.sheets[static_cast<size_t>(i)] = SheetOf(
        results.scene->views[static_cast<size_t>(view_idx)], view_idx, classified, orientation);
  });
  return labels;
}

}  // namespace enfilade
