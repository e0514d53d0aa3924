// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/colmap_features.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/base/child_program.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/base/hash.h"
#include "enfilade/image/codec.h"
#include "enfilade/scene/virtual_view.h"
#include "src/sfm/colmap_database.h"
#include "src/sfm/colmap_extractor.h"
#include "src/sfm/feature_pool.h"
#include "src/sfm/view_ring.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Goes up when other views are rendered than before, so that old databases are not believed.
constexpr std::string_view kViewsVersion = "2";
constexpr float kColmapDescriptorScale = 512;
constexpr std::chrono::seconds kHelpTimeout{30};
constexpr size_t kHashDigits = 16;
constexpr size_t kRecipeDigits = 8;

// A panorama's virtual views and what they are called in the database.
struct ViewPlan {
  ViewRing ring;
  std::vector<std::string> names;  ///< one a view of the ring
};

std::vector<ViewPlan> PlanViews(std::span<const View> panoramas,
                                std::span<const Eigen::Matrix3d> pano_from_walls,
                                const FeatureOptions& options) {
  ENFILADE_CHECK(pano_from_walls.size() == panoramas.size());
  std::vector<ViewPlan> plans;
  for (size_t i = 0; i < panoramas.size(); ++i) {
    const View& pano = panoramas[i];
    ENFILADE_CHECK(pano.sha256.size() >= kHashDigits);
    ViewPlan plan{MakeWallViews(pano.camera, pano_from_walls[i]), {}};
    std::string recipe(kViewsVersion);
    for (const double number : pano_from_walls[i].reshaped()) {
      recipe += fmt::format(" {:.9f}", number);
    }
    for (const std::string& argument :
         ColmapSiftArguments(plan.ring.camera, options.min_contrast)) {
      recipe += " " + argument;
    }
    const std::string stem =
        pano.sha256.substr(0, kHashDigits) + "_" + Sha256(recipe).substr(0, kRecipeDigits) + "_";
    for (size_t k = 0; k < plan.ring.pano_from_view.size(); ++k) {
      plan.names.push_back(stem + std::to_string(k) + ".png");
    }
    plans.push_back(std::move(plan));
  }
  return plans;
}

// Panoramas whose views share one camera, and the names of their views to be worked on.
struct Batch {
  Camera camera;
  std::vector<size_t> pano_idx;
  std::set<std::string> names;
};

std::vector<Batch> BatchesWithout(const std::set<std::string>& known,
                                  std::span<const ViewPlan> plans) {
  std::map<std::tuple<int, int, double>, Batch> batch_of_camera;
  for (size_t i = 0; i < plans.size(); ++i) {
    const Camera& camera = plans[i].ring.camera;
    Batch& batch = batch_of_camera[{camera.width, camera.height, camera.fx}];
    batch.camera = camera;
    // Of panoramas that are there twice the first one counts.
    bool has_any = false;
    for (const std::string& name : plans[i].names) {
      if (!known.contains(name)) has_any = batch.names.insert(name).second || has_any;
    }
    if (has_any) batch.pano_idx.push_back(i);
  }
  std::vector<Batch> batches;
  for (auto& [key, batch] : batch_of_camera) {
    if (!batch.names.empty()) batches.push_back(std::move(batch));
  }
  return batches;
}

void RenderViews(const View& pano, const ViewPlan& plan, const std::set<std::string>& wanted,
                 const fs::path& folder) {
  const ImageU8 gray = ReadImageGray(pano.path);
  if (gray.rows() != pano.camera.height || gray.cols() != pano.camera.width) {
    throw InvalidInputError(pano.path.native(), "is not of the size that its camera tells",
                            "read the pictures anew");
  }
  for (size_t k = 0; k < plan.names.size(); ++k) {
    if (!wanted.contains(plan.names[k])) continue;
    WriteImage(folder / plan.names[k],
               RenderVirtualView(gray, pano.camera, plan.ring.camera, plan.ring.pano_from_view[k]));
  }
}

// Removes the folder of views on scope exit.
class ViewFolder {
 public:
  ViewFolder(fs::path path, bool is_kept) : path_(std::move(path)), is_kept_(is_kept) {}
  ~ViewFolder() {
    std::error_code ignored;
    if (!is_kept_) fs::remove_all(path_, ignored);
  }
  ViewFolder(const ViewFolder&) = delete;
  ViewFolder& operator=(const ViewFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  bool is_kept_;
};

fs::path Beside(const fs::path& database, std::string_view ending) {
  fs::path path = database;
  path.replace_filename(database.stem());
  path += ending;
  return path;
}

void CompleteDatabase(std::span<const View> panoramas, std::span<const ViewPlan> plans,
                      const FeatureOptions& options, const fs::path& database,
                      RunContext& context) {
  const std::vector<Batch> batches = BatchesWithout(ReadPicturesWithFeatures(database), plans);
  const ViewFolder views(Beside(database, "_views"), options.keep_colmap_views);
  if (batches.empty()) return;
  const std::optional<fs::path> program = FindColmap(options.colmap_program);
  if (!program) {
    throw DependencyError(options.colmap_program.empty() ? "colmap" : options.colmap_program,
                          "is not installed or does not run",
                          "install COLMAP or use --sfm.features.source opencv");
  }
  CreateFolder(views.path());
  for (const Batch& batch : batches) {
    ParallelFor(context, "render views", static_cast<int64_t>(batch.pano_idx.size()),
                [&](int64_t i) {
                  const size_t pano_idx = batch.pano_idx[static_cast<size_t>(i)];
                  RenderViews(panoramas[pano_idx], plans[pano_idx], batch.names, views.path());
                });
    RunColmapExtractor({.program = *program,
                        .database = database,
                        .log = Beside(database, ".log"),
                        .views = views.path(),
                        .camera = batch.camera,
                        .pictures = batch.names,
                        .min_contrast = options.min_contrast},
                       context);
  }
}

// COLMAP computes no descriptor for features within 2.5 pixels of their octave of the lower or
// right border and stores what was in memory instead, other bytes in every run. A pixel of the
// octave is at most scale / 1.6.
bool HasDescriptor(const Eigen::Vector2d& pixel, double scale_px, const Camera& camera) {
  const double margin_px = 2 * scale_px;
  return pixel.x() >= margin_px && pixel.x() <= camera.width - margin_px &&
         pixel.y() >= margin_px && pixel.y() <= camera.height - margin_px;
}

PanoFeatures ReadFeatures(const ColmapDatabase& database, const View& pano, const ViewPlan& plan,
                          const Stand& stand, int max_features) {
  const ImageU8 trusted = TrustedPixels(pano, stand);
  FeaturePool pool(pano.camera, plan.ring, trusted);
  for (size_t k = 0; k < plan.names.size(); ++k) {
    const ColmapFeatures found = database.Read(plan.names[k], plan.ring.camera);
    for (size_t i = 0; i < found.pixels.size(); ++i) {
      if (!HasDescriptor(found.pixels[i], found.scales_px[i], plan.ring.camera)) continue;
      std::array<float, kDescriptorSize> root_sift{};
      for (size_t j = 0; j < root_sift.size(); ++j) {
        root_sift[j] = found.descriptors[i * kDescriptorSize + j] / kColmapDescriptorScale;
      }
      // Diameters as OpenCV has them: twice the standard deviation.
      // COLMAP does not say how strong a feature is; large ones are seen from farther away. Size on
      // the sphere, as a pixel subtends less towards the border of a view.
      const double off_axis = plan.ring.camera.RayFromPixel(found.pixels[i]).z();
      pool.Add(static_cast<int>(k), found.pixels[i], 2 * found.scales_px[i],
               found.scales_px[i] * off_axis * off_axis, root_sift.data());
    }
  }
  return pool.Take(max_features);
}

}  // namespace

std::optional<fs::path> FindColmap(const std::string& program) {
  std::optional<fs::path> path = FindProgram(program.empty() ? "colmap" : program);
  if (!path) return std::nullopt;
  const Clock::time_point deadline = Clock::now() + kHelpTimeout;
  struct TimeoutError {};
  try {
    const ProgramEnd end = RunProgram(*path, {"help"}, "/dev/null", [&] {
      if (Clock::now() > deadline) throw TimeoutError();
    });
    return end.IsSuccess() ? path : std::nullopt;
  } catch (const TimeoutError&) {
    return std::nullopt;
  } catch (const DependencyError&) {
    return std::nullopt;
  }
}

FeatureSource ChooseFeatureSource(const FeatureOptions& options) {
  if (options.source != FeatureSource::kAuto) return options.source;
  return FindColmap(options.colmap_program) ? FeatureSource::kColmap : FeatureSource::kOpenCv;
}

std::vector<PanoFeatures> ExtractFeaturesWithColmap(
    std::span<const View> panoramas, std::span<const Eigen::Matrix3d> pano_from_walls,
    const Stand& stand, const FeatureOptions& options, const fs::path& database,
    RunContext& context) {
  if (panoramas.empty()) return {};
  if (database.has_parent_path()) CreateFolder(database.parent_path());
  const std::vector<ViewPlan> plans = PlanViews(panoramas, pano_from_walls, options);
  CompleteDatabase(panoramas, plans, options, database, context);
  const ColmapDatabase complete(database);
  std::vector<PanoFeatures> features(panoramas.size());
  ParallelFor(context, "read features", static_cast<int64_t>(panoramas.size()), [&](int64_t i) {
    const auto idx = static_cast<size_t>(i);
    features[idx] = ReadFeatures(complete, panoramas[idx], plans[idx], stand, options.max_features);
  });
  return features;
}

}  // namespace enfilade
