// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/model/texture.h"

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <tuple>

#include "enfilade/base/errors.h"
#include "enfilade/image/codec.h"
#include "enfilade/model/visibility.h"
#include "src/model/chart.h"
#include "src/model/fill_holes.h"
#include "src/model/render_chart.h"
#include "src/model/tile_views.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

// Colour of a home that no picture shows.
constexpr float kUnseenGrey = 190;

std::string SizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

Picture LoadPicture(const View& view) {
  Picture picture{ReadImageRgb(view.path), {}};
  if (!view.mask_path.empty()) picture.mask = ReadImageGray(view.mask_path);
  const auto check = [&](const ImageU8& image, const std::filesystem::path& path) {
    if (image.empty() ||
        (image.cols() == view.camera.width && image.rows() == view.camera.height)) {
      return;
    }
    throw InvalidInputError(path.native(),
                            "is " + SizeText(image.cols(), image.rows()) + ", but its camera is " +
                                SizeText(view.camera.width, view.camera.height),
                            "use the picture that the poses were made with");
  };
  check(picture.rgb, view.path);
  check(picture.mask, view.mask_path);
  return picture;
}

std::vector<TextureView> MakeTextureViews(const Scene& scene, const Floorplan& plan,
                                          double stand_row) {
  std::vector<TextureView> views;
  for (const View& view : scene.views) {
    views.push_back(MakeTextureView(view, plan.home_from_world, stand_row));
  }
  return views;
}

// The work on one model; its members are the intermediate results, in the order in which they
// arise.
class Texturer {
 public:
  Texturer(const Scene& scene, const Floorplan& plan, const BuildingModel& model,
           const TextureOptions& options, RunContext& context)
      : scene_(scene),
        model_(model),
        options_(options),
        context_(context),
        views_(MakeTextureViews(scene, plan, options.stand_row)),
        visibility_(model, plan),
        charts_(MakeCharts(model, options)) {}

  [[nodiscard]] TextureResult Run() {
    FindViews();
    SampleColours();
    ChooseAll();
    RenderAll();
    FillAll();
    return Assemble();
  }

 private:
  [[nodiscard]] int64_t num_charts() const { return static_cast<int64_t>(charts_.size()); }

  void FindViews() {
    chart_views_.resize(charts_.size());
    ParallelFor(context_, "finding who sees what", num_charts(), [&](int64_t i) {
      const auto f = static_cast<size_t>(i);
      chart_views_[f] = FindChartViews(charts_[f], model_.faces[f], scene_, views_, visibility_);
    });
  }

  void SampleColours() {
    ParallelFor(context_, "comparing pictures", static_cast<int64_t>(views_.size()),
                [&](int64_t v) {
                  if (!IsUsed(static_cast<int>(v))) return;
                  const Picture picture = LoadPicture(scene_.views[static_cast<size_t>(v)]);
                  SampleTileColours(picture.rgb, picture.mask, static_cast<int>(v),
                                    views_[static_cast<size_t>(v)], charts_, chart_views_);
                });
  }

  void ChooseAll() {
    gains_.assign(views_.size(), Vector3d::Ones());
    if (options_.equalise_exposure) gains_ = EstimateGains(chart_views_, views_.size());
    chosen_.resize(charts_.size());
    ParallelFor(context_, "choosing pictures", num_charts(), [&](int64_t i) {
      const auto f = static_cast<size_t>(i);
      chosen_[f] = ChooseViews(charts_[f], chart_views_[f], gains_, options_.seam_cost);
    });
  }

  // Picture by picture, so that one is in memory at a time; sums grow in the order of the views.
  void RenderAll() {
    for (const Chart& chart : charts_) rgbw_.emplace_back(chart.rows, chart.cols, 4);
    for (size_t v = 0; v < views_.size(); ++v) {
      context_.CheckStop();
      if (!IsUsed(static_cast<int>(v))) continue;
      const Picture picture = LoadPicture(scene_.views[v]);
      ParallelFor(context_, "", num_charts(), [&](int64_t i) {
        const auto f = static_cast<size_t>(i);
        for (size_t label = 0; label < chart_views_[f].views.size(); ++label) {
          if (chart_views_[f].views[label].view_idx != static_cast<int>(v)) continue;
          RenderChart(charts_[f], chart_views_[f], chosen_[f], label, views_[v], gains_[v], picture,
                      visibility_, rgbw_[f]);
        }
      });
      if (context_.progress_sink() != nullptr) {
        context_.progress_sink()->Report("painting", static_cast<int64_t>(v) + 1,
                                         static_cast<int64_t>(views_.size()), -1);
      }
    }
  }

  // Divides by the weights and fills what no picture shows.
  void FillAll() {
    std::vector<Eigen::Vector4d> sums(charts_.size());
    std::vector<uint8_t> is_filled(charts_.size());
    ParallelFor(context_, "filling gaps", num_charts(), [&](int64_t i) {
      const auto f = static_cast<size_t>(i);
      sums[f] = Normalise(rgbw_[f]);
      is_filled[f] = FillHoles(rgbw_[f]) ? 1 : 0;
    });
    const auto fallback = MeanColours(sums);
    for (size_t f = 0; f < charts_.size(); ++f) {
      if (is_filled[f] == 0) Paint(fallback(model_.faces[f]), rgbw_[f]);
      num_seen_ += sums[f][3];
    }
  }

  // Colour sums of the texels seen, and their number.
  [[nodiscard]] static Eigen::Vector4d Normalise(ImageF& rgbw) {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (int r = 0; r < rgbw.rows(); ++r) {
      for (int c = 0; c < rgbw.cols(); ++c) {
        const float weight = rgbw(r, c, 3);
        if (weight <= 0) continue;
        for (int k = 0; k < 3; ++k) sum[k] += rgbw(r, c, k) /= weight;
        sum[3] += 1;
      }
    }
    return sum;
  }

  // Mean colour of the like surfaces of the same room, else of the home.
  [[nodiscard]] std::function<Eigen::Vector3f(const ModelFace&)> MeanColours(
      const std::vector<Eigen::Vector4d>& sums) const {
    using Key = std::tuple<int, int, SurfaceKind>;
    const auto room_key = [](const ModelFace& face) {
      return Key(face.storey_idx, face.room_id, face.kind);
    };
    const auto home_key = [](const ModelFace& face) { return Key(-1, -1, face.kind); };
    std::map<Key, Eigen::Vector4d> means;
    for (size_t f = 0; f < sums.size(); ++f) {
      for (const Key& key : {room_key(model_.faces[f]), home_key(model_.faces[f])}) {
        means.try_emplace(key, Eigen::Vector4d::Zero()).first->second += sums[f];
      }
    }
    return [=](const ModelFace& face) -> Eigen::Vector3f {
      for (const Key& key : {room_key(face), home_key(face)}) {
        const Eigen::Vector4d& mean = means.at(key);
        if (mean[3] > 0) return (mean.head<3>() / mean[3]).cast<float>();
      }
      return Eigen::Vector3f::Constant(kUnseenGrey);
    };
  }

  static void Paint(const Eigen::Vector3f& colour, ImageF& rgbw) {
    for (int r = 0; r < rgbw.rows(); ++r) {
      for (int c = 0; c < rgbw.cols(); ++c) {
        for (int k = 0; k < 3; ++k) rgbw(r, c, k) = colour[k];
      }
    }
  }

  [[nodiscard]] TextureResult Assemble() {
    TextureResult result{model_, 0, options_.texels_per_m, gains_};
    const std::vector<AtlasSize> atlases = PackCharts(options_.atlas_px, charts_);
    result.model.textures.clear();
    for (const AtlasSize& size : atlases)
      result.model.textures.emplace_back(size.rows, size.cols, 3);
    double num_texels = 0;
    for (size_t f = 0; f < charts_.size(); ++f) {
      const Chart& chart = charts_[f];
      ImageU8& atlas = result.model.textures[static_cast<size_t>(chart.atlas_idx)];
      CopyToAtlas(chart, rgbw_[f], atlas);
      SetUv(chart, atlas, result.model.faces[f]);
      num_texels += static_cast<double>(
          std::count(chart.is_inside.data().begin(), chart.is_inside.data().end(), uint8_t{1}));
      result.texels_per_m = std::max(f > 0 ? result.texels_per_m : 0.0, chart.texels_per_m);
    }
    result.seen_share = num_texels > 0 ? num_seen_ / num_texels : 0;
    return result;
  }

  static void CopyToAtlas(const Chart& chart, const ImageF& rgbw, ImageU8& atlas) {
    constexpr int kPad = kChartPadding_px;
    for (int r = -kPad; r < chart.rows + kPad; ++r) {
      const int row = std::clamp(r, 0, chart.rows - 1);
      for (int c = -kPad; c < chart.cols + kPad; ++c) {
        const int col = std::clamp(c, 0, chart.cols - 1);
        for (int k = 0; k < 3; ++k) {
          atlas(chart.atlas_row + r, chart.atlas_col + c, k) =
              static_cast<uint8_t>(std::clamp(rgbw(row, col, k), 0.0F, 255.0F) + 0.5F);
        }
      }
    }
  }

  static void SetUv(const Chart& chart, const ImageU8& atlas, ModelFace& face) {
    face.texture_idx = chart.atlas_idx;
    face.uv.clear();
    for (const Vector3d& p : face.vertices) {
      const Eigen::Vector2d texel =
          chart.TexelOf(p) + Eigen::Vector2d(chart.atlas_col, chart.atlas_row);
      face.uv.push_back(texel.cwiseQuotient(Eigen::Vector2d(atlas.cols(), atlas.rows())));
    }
  }

  [[nodiscard]] bool IsUsed(int view_idx) const {
    return std::any_of(chart_views_.begin(), chart_views_.end(), [&](const ChartViews& views) {
      return std::any_of(views.views.begin(), views.views.end(),
                         [&](const ChartView& view) { return view.view_idx == view_idx; });
    });
  }

  const Scene& scene_;
  const BuildingModel& model_;
  const TextureOptions& options_;
  RunContext& context_;
  std::vector<TextureView> views_;
  Visibility visibility_;
  std::vector<Chart> charts_;
  std::vector<ChartViews> chart_views_;
  std::vector<Vector3d> gains_;
  std::vector<std::vector<int>> chosen_;  // per chart and tile, as ChooseViews gives them
  std::vector<ImageF> rgbw_;
  double num_seen_ = 0;
};

}  // namespace

TextureResult TextureModel(const Scene& scene, const Floorplan& plan, BuildingModel model,
                           const TextureOptions& options, RunContext& context) {
  if (scene.views.empty() || model.faces.empty())
    return {std::move(model), 0, options.texels_per_m, {}};
  return Texturer(scene, plan, model, options, context).Run();
}

}  // namespace enfilade
