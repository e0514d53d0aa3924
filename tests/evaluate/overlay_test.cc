// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/overlay.h"

#include <gtest/gtest.h>

#include "enfilade/base/file.h"
#include "enfilade/evaluate/report.h"
#include "enfilade/image/codec.h"
#include "tests/evaluate/small_home.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

class Overlay : public testing::Test {
 protected:
  Overlay() {
    // Room 0 is 30 cm too wide on its left, room 1 is missed.
    const std::vector<Ring2> rooms = {ParseRing("-0.3,0 4,0 4,3 -0.3,3"), SmallHomeRooms()[2]};
    const std::vector<PlanCamera> cameras = home_.plan.cameras;
    home_.plan = MakePlan(rooms, SmallHomeDoors());
    home_.plan.cameras = cameras;
    input_ = {&home_.scene, &home_.structure, &home_.plan};
    RunContext context(1);
    report_ = Evaluate(input_, home_.truth, {}, context);
  }

  [[nodiscard]] ImageU8 Render(const OverlayOptions& options) const {
    const TempFolder folder;
    WriteFileAtomic(folder / "overlay.png",
                    RenderOverlayPng(input_, home_.truth, report_, options));
    return ReadImageRgb(folder / "overlay.png");
  }

  SmallHome home_ = MakeSmallHome();
  EvaluationInput input_;
  EvaluationReport report_;
};

TEST_F(Overlay, ShowsWhatIsMissedAndWhatIsTooMuch) {
  const ImageU8 image = Render({});
  // 8.4 by 4.6 m, the longer side 1100 px, a margin of 30 px; the page is 663 px high.
  const auto pixel = [&](double x, double y, int channel) {
    const double px_per_m = 1100 / 8.4;
    return static_cast<int>(image(static_cast<int>(image.rows() - 30 - px_per_m * y),
                                  static_cast<int>(30 + px_per_m * (x + 0.3)), channel));
  };
  EXPECT_EQ(image.rows(), 663);
  EXPECT_NEAR(pixel(2, 1, 0), 0.90 * 255, 1);                  // pale: truth that the plan has
  EXPECT_GT(pixel(5, 1, 2), pixel(5, 1, 0) + 40);              // blue: missed
  EXPECT_GT(pixel(-0.15, 1.5, 0), pixel(-0.15, 1.5, 2) + 60);  // orange: too much
}

TEST_F(Overlay, ProfilesChangeThePicture) {
  OverlayOptions options;
  options.longest_side_px = 300;
  const ImageU8 without = Render(options);
  options.draw_profiles = true;
  EXPECT_TRUE(Render(options).data() != without.data());
}

TEST_F(Overlay, SvgHasTheSizeOfThePicture) {
  const std::string svg = RenderOverlaySvg(input_, home_.truth, report_);
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("height=\"663px\""), std::string::npos) << svg.substr(0, 400);
  EXPECT_TRUE(svg == RenderOverlaySvg(input_, home_.truth, report_)) << "not the same bytes twice";
}

TEST_F(Overlay, IsDrawnWhateverIsMissing) {
  EvaluationReport empty;
  empty.figures = EmptyReport();
  EXPECT_FALSE(RenderOverlayPng({}, GroundTruth(), empty).empty());
  EXPECT_FALSE(RenderOverlayPng({}, home_.truth, empty).empty());
  EXPECT_FALSE(RenderOverlaySvg({nullptr, nullptr, &home_.plan}, GroundTruth(), empty).empty());
}

}  // namespace
}  // namespace enfilade
