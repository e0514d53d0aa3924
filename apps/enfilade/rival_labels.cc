// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/rival_labels.h"

#include <fmt/format.h>

#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/evaluate/labels.h"
#include "enfilade/evaluate/picture_matching.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/pipeline/label_file.h"
#include "enfilade/pipeline/pipeline.h"
#include "enfilade/structure/analyze.h"
#include "enfilade/structure/level_panorama.h"

namespace enfilade {
namespace {

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

}  // namespace

RivalLabels MakeOrientationMaps(const Workspace& workspace, const Results& results,
                                const std::optional<GroundTruth>& truth,
                                const OrientationMapOptions& options, RunContext& context) {
  if (!results.structure) {
    throw InvalidInputError(workspace.root().native(), "holds no wall profiles",
                            "run 'enfilade run' or 'enfilade structure' first");
  }
  const Scene scene = ReadSceneWithPictures(workspace);
  const Structure& structure = *results.structure;
  const std::filesystem::path folder = workspace.baselines_folder() / "orientation";
  RemoveFiles(workspace, {folder.lexically_relative(workspace.root())});
  CreateFolder(folder);
  ParallelFor(
      context, "orientation maps", static_cast<int64_t>(scene.views.size()), [&](int64_t i) {
        const View& view = scene.views[static_cast<size_t>(i)];
        if (view.camera.model != CameraModel::kEquirectangular) return;
        const ImageU8 picture = ReadImageRgb(view.path);
        const LevelPanorama panorama = MakeLevelPanorama(
            view, picture, structure.home_from_world, LevelWidth(view, options.width),
            DegToRad(StructureOptions().stand_elevation_deg));
        const ImageU8 labels = MapOrientations(panorama.rgb, options).labels;
        const LabelMaps level{ImageU8(labels.rows(), labels.cols()), CompletedByColumn(labels),
                              labels};
        const LabelMaps maps =
            MapsInCamera(level, structure.home_from_world.rotation * view.world_from_cam.rotation);
        WriteLabelMaps(folder, static_cast<int>(i), maps);
        WriteLabelPicture(folder, static_cast<int>(i), maps, picture);
      });
  RivalLabels figures;
  if (!truth) return figures;
  const std::vector<int> truth_idx = MatchPictures(PictureKeys(scene), PictureKeys(*truth));
  const auto judge = [&](const std::filesystem::path& maps) {
    return EvaluateLabels(
        scene, structure, *truth, truth_idx,
        [&](int view_idx) { return ReadLabelMaps(maps, view_idx); }, context);
  };
  const LabelFigures own = judge(workspace.structure_folder()), rival = judge(folder);
  return {own.accuracy, own.superpixel_accuracy, rival.superpixel_accuracy,
          rival.free_space_accuracy};
}

std::string FormatRivalLabels(const RivalLabels& labels) {
  return fmt::format(
      "labels right: wall profiles {}, superpixels {}, orientation maps {} (completed {})\n",
      FigureText(labels.profile), FigureText(labels.superpixels), FigureText(labels.orientation),
      FigureText(labels.orientation_completed));
}

}  // namespace enfilade
