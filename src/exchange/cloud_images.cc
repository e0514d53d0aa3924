// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/cloud_images.h"

#include <initializer_list>
#include <map>
#include <sstream>
#include <system_error>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "src/exchange/colmap_rig.h"
#include "src/exchange/pose_file.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kMaxListBytes = uint64_t{1} << 26;
constexpr int kNone = -1;

bool Exists(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

[[noreturn]] void FailWithoutList(const fs::path& counts, const std::string& wanted) {
  throw InvalidInputError(counts.native(), "counts images, and " + wanted + " to tell their names",
                          "give it with --points-images: the folder of the COLMAP model, or a text "
                          "file with a picture's name a line");
}

// The model in a folder or where COLMAP puts it below; empty for none.
fs::path FindModel(const fs::path& folder) {
  for (const fs::path& model : {folder, folder / "sparse", folder / "sparse" / "0"}) {
    if (HasColmapModel(model)) return model;
  }
  return {};
}

// What a name is looked up by, the surest first.
std::vector<std::string> KeysOf(const fs::path& name) {
  const fs::path folder = name.parent_path().filename();
  return {(folder / name.filename()).generic_string(), name.filename().native(),
          name.stem().native()};
}

class ViewFinder {
 public:
  explicit ViewFinder(const Scene& scene) {
    const std::vector<std::string> rig_names = RigPictureNames(scene);
    for (size_t i = 0; i < scene.views.size(); ++i) {
      const View& view = scene.views[i];
      const int view_idx = static_cast<int>(i);
      for (const std::string& key : KeysOf(view.path.empty() ? fs::path(view.picture) : view.path))
        AddPicture(key, view_idx);
      view_of_rig_[fs::path(rig_names[i]).filename().native()] = view_idx;
    }
  }

  [[nodiscard]] int Find(const fs::path& image) const {
    const bool is_of_rig = image.parent_path().filename().native().starts_with("view_");
    if (is_of_rig) {
      const auto it = view_of_rig_.find(image.filename().native());
      if (it != view_of_rig_.end()) return it->second;
    }
    for (const std::string& key : KeysOf(image)) {
      const auto it = view_of_picture_.find(key);
      if (it != view_of_picture_.end() && it->second != kNone) return it->second;
    }
    return kNone;
  }

 private:
  // A name of two views is of none.
  void AddPicture(const std::string& key, int view_idx) {
    const auto it = view_of_picture_.emplace(key, view_idx).first;
    if (it->second != view_idx) it->second = kNone;
  }

  std::map<std::string, int> view_of_picture_;
  std::map<std::string, int> view_of_rig_;
};

}  // namespace

fs::path FindPmvsImages(const fs::path& patches) {
  const fs::path folder = fs::absolute(patches).parent_path();
  for (const fs::path& place : {folder, folder.parent_path()}) {
    for (const char* name : {"bundle.rd.out.list.txt", "list.txt"}) {
      if (Exists(place / name)) return place / name;
    }
  }
  FailWithoutList(patches, "no bundle.rd.out.list.txt or list.txt is beside it or above");
}

fs::path FindColmapImages(const fs::path& ply) {
  fs::path model = FindModel(fs::absolute(ply).parent_path());
  if (model.empty()) {
    FailWithoutList(ply.native() + ".vis", "no COLMAP model (sparse/) is beside it");
  }
  return model;
}

fs::path FileOfImages(const fs::path& list) {
  if (!Exists(list)) {
    throw IoError(list.native(), "does not exist", "check the path given with --points-images");
  }
  if (!fs::is_directory(list)) return list;
  const fs::path model = FindModel(list);
  if (model.empty()) {
    throw InvalidInputError(list.native(),
                            "holds no COLMAP model (cameras and images, .bin or .txt)",
                            "name the folder of the model or a list of pictures");
  }
  return Exists(model / "images.bin") ? model / "images.bin" : model / "images.txt";
}

std::vector<CloudImage> ReadCloudImages(const fs::path& list) {
  const fs::path file = FileOfImages(list);
  std::vector<CloudImage> images;
  if (file != list) {
    for (const PosedPicture& picture : ReadColmapModel(file.parent_path()).pictures)
      images.push_back({picture.name, picture.world_from_cam.translation});
  } else {
    std::istringstream lines(ReadFile(list, kMaxListBytes));
    for (std::string line; std::getline(lines, line);) {
      const size_t end = line.find_last_not_of(" \t\r");
      images.push_back({end == std::string::npos ? "" : line.substr(0, end + 1), {}});
    }
    while (!images.empty() && images.back().name.empty()) images.pop_back();
  }
  if (images.empty()) {
    throw InvalidInputError(list.native(), "names no images", "give the list of all of them");
  }
  return images;
}

std::vector<int> ViewsOfImages(std::span<const CloudImage> images, const Scene& scene) {
  const ViewFinder finder(scene);
  std::vector<int> view_of;
  for (const auto& [name, position] : images) {
    const int whole = finder.Find(name);
    view_of.push_back(whole != kNone ? whole : finder.Find(name.substr(0, name.find(' '))));
  }
  return view_of;
}

}  // namespace enfilade
