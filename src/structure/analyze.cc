// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/analyze.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/median.h"
#include "enfilade/evidence/accumulate.h"
#include "enfilade/evidence/core.h"
#include "enfilade/evidence/point_labels.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/codec.h"
#include "enfilade/structure/level_panorama.h"
#include "enfilade/structure/room_mates.h"
#include "enfilade/structure/wall_confidence.h"
#include "enfilade/structure/wall_samples.h"
#include "src/structure/label_view.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Width at which headings are voted.
constexpr int kHeadingWidth = 1024;
// The search for heights looks at every so many columns.
constexpr int kHeightColumnStep = 4;
// Correlation is computed at every so many columns.
constexpr int kCorrelationColumnStep = 4;
constexpr std::array kCorrelatedFamilies = {0, 1, kFrontalFamily};
// So well a ceiling's height is known: its line may be this far off.
constexpr double kCeilingError_m = 0.02;
// Cells of the free space that bounds where walls may stand.
constexpr double kLabelCell_m = 0.05;
// Between a camera and floor or ceiling, whatever was found.
constexpr double kLeastHeight_m = 0.1;

// What is kept of one panorama while its storey is solved.
struct ViewWork {
  Vector3d position{0, 0, 0};
  LineResponse response;
  std::vector<uint8_t> is_seen;  // per column
  ColumnScores correlation;      // weighed
  ColumnScores lines;            // weighed floor and ceiling lines
  WallPath path;
  CeilingEstimate ceiling;
  ClassifyView label_view;
  Classification classification;
  ColumnScores labels;  // weighed; empty until there are labels
};

double EstimateHeading(const Scene& scene, const StructureOptions& options, RunContext& context) {
  std::vector<HeadingHistogram> histograms(scene.views.size());
  ParallelFor(context, "heading", static_cast<int64_t>(scene.views.size()), [&](int64_t i) {
    const View& view = scene.views[static_cast<size_t>(i)];
    const LevelPanorama panorama =
        MakeLevelPanorama(view, ReadImageRgb(view.path), Rigid3(), LevelWidth(view, kHeadingWidth),
                          DegToRad(options.stand_elevation_deg));
    histograms[static_cast<size_t>(i)] = VoteHeading(panorama, options.heading);
  });
  HeadingHistogram pooled(histograms.front().size());
  for (const HeadingHistogram& histogram : histograms) {
    for (size_t b = 0; b < pooled.size(); ++b) pooled[b] += histogram[b];
  }
  return HeadingOfHistogram(pooled, options.heading);
}

std::vector<int> UsedFamilies(const StructureOptions& options) {
  std::vector<int> families = {0, 1};
  if (options.use_diagonals) families.insert(families.end(), {2, 3});
  if (options.use_frontal) families.push_back(kFrontalFamily);
  return families;
}

DistanceBins MakeBins(const StructureOptions& options) {
  DistanceBins bins;
  bins.count = static_cast<int>(std::ceil(bins.Bin(options.max_distance_m))) + 1;
  return bins;
}

double MedianCameraZ(const std::vector<ViewWork>& works) {
  std::vector<double> z;
  for (const ViewWork& work : works) z.push_back(work.position.z());
  return UpperMedian(std::move(z));
}

// Solves the panoramas of one storey.
class StoreySolver {
 public:
  StoreySolver(const Scene& scene, std::vector<int> members, const Rigid3& home_from_world,
               const StructureOptions& options, RunContext& context)
      : scene_(scene),
        members_(std::move(members)),
        home_from_world_(home_from_world),
        options_(options),
        context_(context),
        bins_(MakeBins(options)),
        families_(UsedFamilies(options)),
        works_(members_.size()) {}

  void Solve() {
    LoadPanoramas();
    if (options_.use_correlation) Correlate();
    EstimateFloorHeight();
    ScoreLines(false);
    FindPaths(false);
    if (options_.use_correlation) Correlate();
    if (options_.use_ceiling) EstimateCeilingHeights();
    ScoreLines(options_.use_ceiling);
    FindPaths(!options_.use_shared);
    if (options_.use_shared) FindPathsTogether();
    if (options_.mode == StructureMode::kProfile) return;
    Classify();
    if (options_.mode == StructureMode::kPaper) {
      FindPathsOfLabels();
    } else {
      options_.use_shared ? FindPathsTogether() : FindPaths(true);
    }
  }

  [[nodiscard]] StoreyStructure storey() const {
    std::vector<double> ceilings;
    for (const ViewWork& work : works_) ceilings.push_back(work.ceiling.ceiling_z);
    return {floor_.floor_z, UpperMedian(std::move(ceilings)), floor_.baseboard.height_m};
  }

  [[nodiscard]] WallProfile Profile(size_t i) const {
    const ViewWork& work = works_[i];
    WallProfile profile;
    profile.view_idx = members_[i];
    profile.floor_z = floor_.floor_z;
    profile.ceiling_z = work.ceiling.ceiling_z;
    profile.ceiling_weight = work.ceiling.weight;
    profile.is_seen = work.is_seen;
    profile.wall_probability = Probabilities(work.path.log_likelihood);
    const std::vector<double> obstacles = Obstacles(work);
    profile.wall_m.assign(work.path.wall_m.begin(), work.path.wall_m.end());
    profile.obstacle_m.assign(obstacles.begin(), obstacles.end());
    profile.confidence =
        WallConfidence(work.path, work.lines, work.is_seen, bins_, options_.clear_response);
    return profile;
  }

  // Moves the panoramas' classifications to their views.
  void TakeClassifications(std::vector<Classification>& classifications) {
    ParallelFor(context_, "", static_cast<int64_t>(works_.size()), [&](int64_t i) {
      const auto view_idx = static_cast<size_t>(members_[static_cast<size_t>(i)]);
      Classification& result = classifications[view_idx];
      result = std::move(works_[static_cast<size_t>(i)].classification);
      const Eigen::Matrix3d home_from_cam =
          home_from_world_.rotation * scene_.views[view_idx].world_from_cam.rotation;
      result.maps = MapsInCamera(result.maps, home_from_cam);
    });
  }

  [[nodiscard]] const DistanceBins& bins() const { return bins_; }
  [[nodiscard]] const std::vector<int>& members() const { return members_; }

 private:
  void LoadPanoramas() {
    std::vector<std::unique_ptr<StripTable>> tables(members_.size());
    double camera_z = 0;
    for (const int v : members_) {
      camera_z +=
          (home_from_world_ * scene_.views[static_cast<size_t>(v)].world_from_cam.translation).z();
    }
    camera_z /= static_cast<double>(members_.size());
    ParallelFor(context_, "panoramas", static_cast<int64_t>(members_.size()), [&](int64_t i) {
      const View& view = scene_.views[static_cast<size_t>(members_[static_cast<size_t>(i)])];
      const int width =
          std::max(options_.num_columns, LevelWidth(view, options_.max_width) /
                                             options_.num_columns * options_.num_columns);
      const LevelPanorama panorama =
          MakeLevelPanorama(view, ReadImageRgb(view.path), home_from_world_, width,
                            DegToRad(options_.stand_elevation_deg));
      ViewWork& work = works_[static_cast<size_t>(i)];
      work.position = panorama.position;
      work.response = ComputeLineResponse(panorama, options_.num_columns, families_, options_.line);
      work.is_seen = SeenColumns(panorama);
      if (options_.mode != StructureMode::kProfile)
        work.label_view = MakeLabelView(panorama, work.response, options_.classify);
      if (options_.use_correlation) {
        tables[static_cast<size_t>(i)] =
            std::make_unique<StripTable>(panorama, camera_z - options_.correlation.below_m,
                                         camera_z + options_.correlation.above_m, bins_);
      }
    });
    for (auto& table : tables) {
      if (table) tables_.push_back(std::move(*table));
    }
  }

  // A column is seen when the picture covers the level line in it.
  [[nodiscard]] std::vector<uint8_t> SeenColumns(const LevelPanorama& panorama) const {
    std::vector<uint8_t> is_seen;
    const int step = panorama.cols() / options_.num_columns;
    for (int c = 0; c < options_.num_columns; ++c) {
      is_seen.push_back(panorama.is_seen(panorama.rows() / 2, c * step + step / 2));
    }
    return is_seen;
  }

  void Correlate() {
    const std::vector<KnownDistances> known = Walls();
    const std::vector<Vector2d> positions = Positions();
    ParallelFor(context_, "correlation", static_cast<int64_t>(works_.size()), [&](int64_t i) {
      const ColumnScores raw = CorrelateStrips(tables_, static_cast<int>(i),
                                               NearestOthers(positions, static_cast<size_t>(i)),
                                               known, options_.num_columns, kCorrelationColumnStep,
                                               kCorrelatedFamilies, bins_, options_.correlation);
      ColumnScores weighed;
      AddScores(raw, options_.correlation_weight, weighed);
      // A strip is narrow: at 45 degrees it looks much as it does frontally.
      weighed.family[2] = weighed.family[3] = weighed.family[kFrontalFamily];
      DropUnusedFamilies(weighed);
      works_[static_cast<size_t>(i)].correlation = std::move(weighed);
    });
  }

  // The two axis families at few columns: enough for heights.
  template <typename Use>
  void WithHeightViews(const Use& use) const {
    std::vector<LineResponse> responses(works_.size());
    std::vector<ColumnScores> correlations(works_.size());
    std::vector<HeightView> views;
    for (size_t i = 0; i < works_.size(); ++i) {
      responses[i] = Thin(works_[i].response);
      correlations[i] = Thin(works_[i].correlation);
      // Without correlation only the floor line tells how high the floor is.
      views.push_back({&responses[i], &correlations[i], works_[i].position,
                       options_.use_floor || !options_.use_correlation});
    }
    use(views);
  }

  [[nodiscard]] static LineResponse Thin(const LineResponse& response) {
    LineResponse thin{std::vector<ImageU8>(kNumFamilies)};
    for (const size_t f : {0, 1}) {
      const ImageU8& source = response.family[f];
      ImageU8 target(source.rows(), source.cols() / kHeightColumnStep);
      for (int r = 0; r < target.rows(); ++r) {
        for (int c = 0; c < target.cols(); ++c)
          target(r, c) = source(r, c * kHeightColumnStep + kHeightColumnStep / 2);
      }
      thin.family[f] = std::move(target);
    }
    return thin;
  }

  [[nodiscard]] static ColumnScores Thin(const ColumnScores& scores) {
    ColumnScores thin;
    for (const size_t f : {0, 1}) {
      const ImageF& source = scores.family[f];
      if (source.empty()) continue;
      ImageF target(source.rows() / kHeightColumnStep, source.cols());
      for (int c = 0; c < target.rows(); ++c) {
        std::copy_n(source.row(c * kHeightColumnStep + kHeightColumnStep / 2), source.cols(),
                    target.row(c));
      }
      thin.family[f] = std::move(target);
    }
    return thin;
  }

  void EstimateFloorHeight() {
    WithHeightViews([&](const std::vector<HeightView>& views) {
      floor_ = EstimateFloor(views, scene_.camera_height_m.value_or(0.0), bins_, options_.viterbi,
                             options_.height, context_);
    });
    context_.log().Info(fmt::format(
        "floor at {:.3f} m, {:.3f} m below the median camera, baseboard {:.2f} m, contrast {:.3f}",
        floor_.floor_z, MedianCameraZ(works_) - floor_.floor_z, floor_.baseboard.height_m,
        floor_.contrast));
  }

  void EstimateCeilingHeights() {
    std::vector<CeilingEstimate> estimates;
    WithHeightViews([&](const std::vector<HeightView>& views) {
      estimates = EstimateCeilings(views, floor_, FindRoomMates(Positions(), Walls()),
                                   options_.use_obstacles ? &options_.obstacle : nullptr, bins_,
                                   options_.viterbi, options_.height, context_);
    });
    for (size_t i = 0; i < works_.size(); ++i) works_[i].ceiling = estimates[i];
  }

  [[nodiscard]] std::vector<Vector2d> Positions() const {
    std::vector<Vector2d> positions;
    for (const ViewWork& work : works_) positions.push_back(work.position.head<2>());
    return positions;
  }

  // Where each panorama has its walls so far.
  [[nodiscard]] std::vector<KnownDistances> Walls() const {
    std::vector<KnownDistances> walls;
    for (const ViewWork& work : works_) walls.push_back(work.path.wall_m);
    return walls;
  }

  [[nodiscard]] ColumnScores FloorScores(const ViewWork& work) const {
    const double floor_m = work.position.z() - floor_.floor_z;
    return StopFloorLines(ScoreFloor(work.response, floor_m, floor_.baseboard, bins_), floor_m,
                          bins_, options_.floor_end);
  }

  [[nodiscard]] ColumnScores CeilingScores(const ViewWork& work) const {
    // A centimetre of the ceiling's height is worth more of the distance than one of the floor's,
    // so the ceiling line says which wall it is and the floor line where.
    const double above_m = work.ceiling.line_z - work.position.z();
    const double reach = kCeilingError_m / above_m / bins_.log_step;
    return WidenScores(ScoreLine(work.response, -above_m, bins_),
                       static_cast<int>(std::lround(reach)));
  }

  void DropUnusedFamilies(ColumnScores& scores) const {
    for (int f = 0; f < kNumFamilies; ++f) {
      if (std::find(families_.begin(), families_.end(), f) == families_.end()) {
        scores.family[static_cast<size_t>(f)] = ImageF();
      }
    }
  }

  [[nodiscard]] ColumnScores NoScores() const {
    ColumnScores scores;
    for (const int f : families_)
      scores.family[static_cast<size_t>(f)] = ImageF(options_.num_columns, bins_.count);
    return scores;
  }

  // Floor and ceiling lines, weighed. Where the ceiling ends also says what floor lines and
  // correlation are worth.
  void ScoreLines(bool with_ceiling) {
    ParallelFor(context_, "lines", static_cast<int64_t>(works_.size()), [&](int64_t i) {
      ViewWork& work = works_[static_cast<size_t>(i)];
      ColumnScores floor, ceiling;
      if (options_.use_floor) floor = FloorScores(work);
      if (with_ceiling) {
        AddScores(CeilingScores(work), work.ceiling.weight, ceiling);
        const ImageF kept = CeilingEnds(ceiling, bins_, options_.ceiling_end);
        ScaleScores(kept, floor);
        ScaleScores(kept, work.correlation);
        // Only the ceiling line can tell a wall behind an obstacle from the obstacle.
        if (options_.use_obstacles) floor = AllowObstacles(floor, bins_, options_.obstacle);
      }
      work.lines = ColumnScores();
      AddScores(floor, options_.floor_weight, work.lines);
      AddScores(ceiling, options_.ceiling_weight, work.lines);
    });
  }

  void FindPaths(bool with_likelihood) {
    ParallelFor(context_, "wall profiles", static_cast<int64_t>(works_.size()), [&](int64_t i) {
      ViewWork& work = works_[static_cast<size_t>(i)];
      ColumnScores scores = work.lines;
      // The ceiling line alone comes after the first paths, for which nothing is known then.
      if (!options_.use_floor && !options_.use_correlation) AddScores(NoScores(), 1.0, scores);
      AddScores(work.correlation, 1.0, scores);
      AddScores(work.labels, 1.0, scores);
      work.path = FindWallPath(scores, bins_, options_.viterbi, with_likelihood);
    });
  }

  // Once more, each panorama with what the others of its room say to its walls. Only those: through
  // a door another room's panorama would support what lies behind this one's walls.
  void FindPathsTogether() {
    const std::vector<KnownDistances> known = Walls();
    const std::vector<Vector2d> positions = Positions();
    std::vector<PlacedScores> views;
    for (size_t i = 0; i < works_.size(); ++i) views.push_back({positions[i], &works_[i].lines});
    const std::vector<std::vector<RoomMate>> room_mates = FindRoomMates(positions, known);
    ParallelFor(context_, "shared profiles", static_cast<int64_t>(works_.size()), [&](int64_t i) {
      ViewWork& work = works_[static_cast<size_t>(i)];
      const std::vector<RoomMate>& mates = room_mates[static_cast<size_t>(i)];
      std::vector<int> others = NearestOthers(positions, static_cast<size_t>(i));
      std::erase_if(others, [&](int j) {
        return std::none_of(mates.begin(), mates.end(),
                            [&](const RoomMate& mate) { return mate.view == j; });
      });
      const ColumnScores ceiling = CeilingScores(work);
      ColumnScores scores = work.lines;
      AddScores(work.correlation, 1.0, scores);
      AddScores(ShareScores(views, static_cast<int>(i), others, known,
                            options_.use_ceiling ? &ceiling : nullptr, kCorrelationColumnStep,
                            bins_, options_.shared),
                options_.shared_weight, scores);
      AddScores(work.labels, 1.0, scores);
      work.path = FindWallPath(scores, bins_, options_.viterbi, true);
    });
  }

  // The profiles so far, and nothing for the other panoramas.
  [[nodiscard]] Structure StructureSoFar() const {
    Structure structure;
    structure.home_from_world = home_from_world_;
    structure.bin_m = bins_.Centers();
    structure.profiles.resize(scene_.views.size());
    for (size_t i = 0; i < works_.size(); ++i)
      structure.profiles[static_cast<size_t>(members_[i])] = Profile(i);
    return structure;
  }

  // Floor, wall and ceiling of every panorama, from the core of what the profiles see free.
  void Classify() {
    const int storey_idx = scene_.views[static_cast<size_t>(members_.front())].storey_idx;
    AccumulateOptions grid;
    grid.cell_m = kLabelCell_m;
    EvidenceGrids evidence =
        AccumulateEvidence(MakeWallSamples(StructureSoFar(), scene_, storey_idx), {}, grid,
                           context_)
            .grids;
    if (!evidence.free.empty()) evidence.core = FindCore(evidence, {}, context_).core;
    std::vector<ClassifyView> views;
    for (ViewWork& work : works_) {
      ClassifyView& view = views.emplace_back(std::move(work.label_view));
      const double ceiling_z = options_.use_ceiling
                                   ? work.ceiling.ceiling_z
                                   : floor_.floor_z + options_.height.typical_room_m;
      view.floor_m = std::max(kLeastHeight_m, work.position.z() - floor_.floor_z);
      view.ceiling_m = std::max(kLeastHeight_m, ceiling_z - work.position.z());
      // The paper has nothing but free space.
      if (options_.mode == StructureMode::kJoint) view.wall_m = work.path.wall_m;
      if (!evidence.core.empty()) {
        view.clear_m =
            ClearDistances(evidence, work.position.head<2>(), view.superpixels.label.cols());
      }
    }
    AddSeenPoints(views);
    std::vector<Classification> results = ClassifyPanoramas(views, options_.classify, context_);
    TellOfSeeds(results);
    ParallelFor(context_, "label scores", static_cast<int64_t>(works_.size()), [&](int64_t i) {
      const auto k = static_cast<size_t>(i);
      ViewWork& work = works_[k];
      work.classification = std::move(results[k]);
      work.labels = ColumnScores();
      AddScores(ScoreLabels(views[k], work.classification, options_.num_columns, bins_,
                            options_.max_label_loss),
                options_.label_weight, work.labels);
      DropUnusedFamilies(work.labels);
    });
  }

  // Every point with the panoramas that see it, labelled by the heights that these have found.
  void AddSeenPoints(std::vector<ClassifyView>& views) const {
    std::vector<int> work_of_view(scene_.views.size(), -1);
    for (size_t i = 0; i < members_.size(); ++i)
      work_of_view[static_cast<size_t>(members_[i])] = static_cast<int>(i);
    for (const ScenePoint& point : scene_.points) {
      const Vector3d position = home_from_world_ * point.position;
      for (const int v : point.view_idx) {
        if (work_of_view[static_cast<size_t>(v)] < 0) continue;
        const auto i = static_cast<size_t>(work_of_view[static_cast<size_t>(v)]);
        // The home is the world turned about z: heights and slopes are the same.
        const SurfaceLabel label = LabelOfPoint(point, floor_.floor_z, works_[i].ceiling.ceiling_z);
        if (label == SurfaceLabel::kOther) continue;
        const Vector3d ray = position - works_[i].position;
        views[i].points.push_back({ray.normalized().cast<float>(), label});
      }
    }
  }

  void TellOfSeeds(const std::vector<Classification>& results) const {
    Classification sum;
    for (const Classification& result : results) {
      sum.energy += result.energy;
      sum.seed_energy += result.seed_energy;
      sum.num_superpixels += result.num_superpixels;
      sum.num_point_seeds += result.num_point_seeds;
      sum.num_free_seeds += result.num_free_seeds;
      sum.num_contradictions += result.num_contradictions;
      for (size_t k = 0; k < 3; ++k) sum.seed_sr[k] += result.seed_sr[k];
    }
    context_.log().Info(fmt::format(
        "{} superpixels: {} labelled by points, {} by free space; energy {:.0f} by themselves, "
        "{:.0f} "
        "together",
        sum.num_superpixels, sum.num_point_seeds, sum.num_free_seeds, sum.seed_energy, sum.energy));
    if (sum.num_contradictions > 0) {
      context_.log().Warning(fmt::format(
          "{} superpixels have points of a wall before the end of free space, which is believed",
          sum.num_contradictions));
    }
    constexpr std::array<std::string_view, 3> kNames = {"floor", "wall", "ceiling"};
    for (size_t k = 0; k < 3; ++k) {
      if (sum.seed_sr[k] > 0) continue;
      context_.log().Warning(fmt::format(
          "no superpixel is surely {}: its labels follow from elevation alone", kNames[k]));
    }
  }

  // Walls by the labels alone.
  void FindPathsOfLabels() {
    ParallelFor(context_, "label profiles", static_cast<int64_t>(works_.size()), [&](int64_t i) {
      ViewWork& work = works_[static_cast<size_t>(i)];
      work.path = FindWallPath(work.labels, bins_, options_.viterbi, true);
    });
  }

  // Distance of the first obstacle: where AllowObstacles found one before the chosen wall.
  [[nodiscard]] std::vector<double> Obstacles(const ViewWork& work) const {
    std::vector<double> obstacles = work.path.wall_m;
    if (!options_.use_obstacles || !options_.use_floor) return obstacles;
    const ColumnScores floor = FloorScores(work);
    for (size_t c = 0; c < obstacles.size(); ++c) {
      const ImageF& score = floor.family[static_cast<size_t>(work.path.family[c])];
      const int column = static_cast<int>(c);
      const double wall_m = work.path.wall_m[c];
      const int wall_bin = bins_.NearestBin(wall_m);
      float best = score(column, wall_bin) + static_cast<float>(options_.obstacle.cost);
      for (int b = 0; b < wall_bin; ++b) {
        const double gap = wall_m - bins_.Distance(b);
        if (gap < options_.obstacle.min_gap_m || gap > options_.obstacle.max_gap_m ||
            score(column, b) <= best)
          continue;
        best = score(column, b);
        obstacles[c] = bins_.Distance(b);
      }
    }
    return obstacles;
  }

  [[nodiscard]] static ImageF Probabilities(const ImageF& log_likelihood) {
    ImageF probabilities(log_likelihood.rows(), log_likelihood.cols());
    for (int c = 0; c < probabilities.rows(); ++c) {
      float sum = 0;
      for (int b = 0; b < probabilities.cols(); ++b)
        sum += probabilities(c, b) = std::exp(log_likelihood(c, b));
      for (int b = 0; b < probabilities.cols(); ++b) probabilities(c, b) /= sum;
    }
    return probabilities;
  }

  const Scene& scene_;
  std::vector<int> members_;
  Rigid3 home_from_world_;
  const StructureOptions& options_;
  RunContext& context_;
  DistanceBins bins_;
  std::vector<int> families_;
  std::vector<ViewWork> works_;
  std::vector<StripTable> tables_;
  FloorEstimate floor_;
};

}  // namespace

std::span<const std::string_view> EnumNames(StructureMode) {
  static constexpr std::array<std::string_view, 3> kNames = {"profile", "joint", "paper"};
  return kNames;
}

StructureReport AnalyzeStructure(const Scene& scene, const StructureOptions& options,
                                 RunContext& context) {
  ENFILADE_CHECK(!scene.views.empty());
  if (!options.use_floor && !options.use_ceiling && !options.use_correlation) {
    throw InvalidInputError("--structure", "no cue is left to find walls by",
                            "turn on use_floor, use_ceiling or use_correlation");
  }
  StructureReport report;
  Structure& structure = report.structure;
  structure.heading_rad = EstimateHeading(scene, options, context);
  structure.home_from_world.rotation = RotationZ(-structure.heading_rad);
  structure.profiles.resize(scene.views.size());
  context.log().Info(
      fmt::format("heading of the walls {:.2f} degrees", RadToDeg(structure.heading_rad)));

  int num_storeys = 0;
  for (const View& view : scene.views) num_storeys = std::max(num_storeys, view.storey_idx + 1);
  for (int s = 0; s < num_storeys; ++s) {
    std::vector<int> members;
    for (size_t i = 0; i < scene.views.size(); ++i) {
      if (scene.views[i].storey_idx == s) members.push_back(static_cast<int>(i));
    }
    ENFILADE_CHECK(!members.empty());
    StoreySolver solver(scene, std::move(members), structure.home_from_world, options, context);
    solver.Solve();
    structure.storeys.push_back(solver.storey());
    structure.bin_m = solver.bins().Centers();
    if (options.mode != StructureMode::kProfile) {
      report.classifications.resize(scene.views.size());
      solver.TakeClassifications(report.classifications);
    }
    for (size_t i = 0; i < solver.members().size(); ++i) {
      WallProfile profile = solver.Profile(i);
      structure.profiles[static_cast<size_t>(profile.view_idx)] = std::move(profile);
    }
  }
  return report;
}

}  // namespace enfilade
