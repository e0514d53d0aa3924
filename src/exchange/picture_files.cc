// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/picture_files.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

bool IsFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::vector<fs::path> PicturesIn(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> pictures;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (IsPictureName(it->path()) && IsFile(it->path())) pictures.push_back(it->path());
  }
  if (error) {
    throw IoError(folder.native(), "cannot be listed: " + error.message(),
                  "check the path and the permissions");
  }
  std::sort(pictures.begin(), pictures.end());
  return pictures;
}

}  // namespace

bool IsPictureName(const fs::path& path) {
  std::string extension = path.extension().native();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  static constexpr std::array<std::string_view, 3> kExtensions = {".jpg", ".jpeg", ".png"};
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

PictureFiles::PictureFiles(const fs::path& folder) {
  for (const char* below : {"", "images", "panos"}) {
    const fs::path candidate = *below == '\0' ? folder : folder / below;
    std::error_code ignored;
    if (*below != '\0' && !fs::is_directory(candidate, ignored)) continue;
    folders_.push_back(candidate);
    for (const fs::path& picture : PicturesIn(candidate)) {
      by_file_name_.emplace(picture.filename().native(), picture);
      all_.push_back(picture);
    }
  }
}

fs::path PictureFiles::Find(const std::string& name, const fs::path& base) const {
  if (IsFile(base / name)) return base / name;
  for (const fs::path& folder : folders_) {
    if (IsFile(folder / name)) return folder / name;
  }
  const auto it = by_file_name_.find(fs::path(name).filename().native());
  return it == by_file_name_.end() ? fs::path() : it->second;
}

}  // namespace enfilade
