// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/exchange/colmap_writer.h"
#include "enfilade/image/codec.h"
#include "src/exchange/pose_file.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
namespace fs = std::filesystem;

// A panorama whose red and green tell the direction of a pixel.
ImageU8 DirectionPanorama(int width) {
  ImageU8 image(width / 2, width, 3);
  for (int r = 0; r < image.rows(); ++r) {
    for (int c = 0; c < width; ++c) {
      image(r, c, 0) =
          static_cast<uint8_t>(std::lround(127 + 120 * std::sin(2 * M_PI * c / width)));
      image(r, c, 1) = static_cast<uint8_t>(250 * r / image.rows());
      image(r, c, 2) = 60;
    }
  }
  return image;
}

class RenderRigPicturesTest : public testing::Test {
 protected:
  void SetUp() override {
    View pano;
    pano.picture = "a b.png";
    pano.path = temp / "in" / pano.picture;
    pano.camera = EquirectangularCamera(256, 128);
    WriteFileAtomic(pano.path, EncodeImage(DirectionPanorama(256), ".png"));
    View small = pano;
    small.picture = "c.png";
    small.path = temp / "in" / small.picture;
    small.camera = EquirectangularCamera(128, 64);
    WriteFileAtomic(small.path, EncodeImage(DirectionPanorama(128), ".png"));
    View photo;
    photo.picture = "d.png";
    photo.path = temp / "in" / photo.picture;
    photo.camera = PinholeCamera(8, 4, 5, 5, 4, 2);
    WriteFileAtomic(photo.path, EncodeImage(ImageU8(4, 8, 3, 9), ".png"));
    scene.views = {pano, small, photo};
  }

  TempFolder temp;
  Scene scene;
};

TEST_F(RenderRigPicturesTest, EveryImageOfTheModelIsThereAndShowsWhatItsCameraSees) {
  RunContext context(2);
  RenderRigPictures(temp / "images", scene, context);
  WriteColmapModel(temp / "sparse", scene, ColmapForm::kPinholeRig, ColmapEncoding::kBinary);
  const PoseFile read = ReadColmapModel(temp / "sparse");
  ASSERT_EQ(read.pictures.size(), 21U);
  for (size_t i = 0; i < 20; ++i) {
    const PosedPicture& picture = read.pictures[i];
    const ImageU8 image = ReadImageRgb(temp / "images" / picture.name);
    ASSERT_EQ(image.cols(), picture.camera.width);
    ASSERT_EQ(image.rows(), picture.camera.height);
    const View& view = scene.views[i / 10];
    const Matrix3d pano_from_view =
        view.world_from_cam.rotation.transpose() * picture.world_from_cam.rotation;
    const ImageU8 panorama = DirectionPanorama(view.camera.width);
    for (int r = 5; r < image.rows(); r += 9) {
      for (int c = 5; c < image.cols(); c += 9) {
        const Vector3d ray = pano_from_view * picture.camera.RayFromPixel({c + 0.5, r + 0.5});
        if (std::abs(ray.y()) > 0.95)
          continue;  // the panorama's colours are not smooth at the poles
        const Vector2d pixel = *view.camera.PixelFromRay(ray);
        const int row = std::min(static_cast<int>(pixel.y()), panorama.rows() - 1);
        const int col = std::min(static_cast<int>(pixel.x()), panorama.cols() - 1);
        // Nearest pixel against bilinear, and JPEG.
        EXPECT_NEAR(image(r, c, 0), panorama(row, col, 0), 10) << picture.name;
        EXPECT_NEAR(image(r, c, 1), panorama(row, col, 1), 10) << picture.name;
      }
    }
  }
  EXPECT_EQ(ReadFile(temp / "images" / read.pictures[20].name), ReadFile(scene.views[2].path));
}

TEST_F(RenderRigPicturesTest, WritesTheSameBytesWithAnyNumberOfThreads) {
  RunContext one(1), four(4);
  RenderRigPictures(temp / "1", scene, one);
  RenderRigPictures(temp / "4", scene, four);
  size_t num_files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(temp / "1")) {
    if (!entry.is_regular_file()) continue;
    ++num_files;
    const fs::path below = entry.path().lexically_relative(temp / "1");
    EXPECT_EQ(ReadFile(entry.path()), ReadFile(temp / "4" / below)) << below;
  }
  EXPECT_EQ(num_files, 21U);
}

TEST_F(RenderRigPicturesTest, SaysWhyItCannotRender) {
  RunContext context(2);
  WriteFileAtomic(temp / "file", "x");
  EXPECT_THROW(RenderRigPictures(temp / "file", scene, context), IoError);
  scene.views[1].camera = EquirectangularCamera(64, 32);
  EXPECT_THROW(RenderRigPictures(temp / "out", scene, context), InvalidInputError);
  scene.views[1].path = temp / "gone.png";
  EXPECT_THROW(RenderRigPictures(temp / "out", scene, context), IoError);
  context.RequestStop();
  EXPECT_THROW(RenderRigPictures(temp / "out", scene, context), StoppedError);
}

}  // namespace
}  // namespace enfilade
