// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace enfilade {

/// True for the extensions that are read as panoramas: .jpg, .jpeg, .png, in any case.
[[nodiscard]] bool IsPictureName(const std::filesystem::path& path);

/// The pictures of an input folder: those in `folder`, `folder/images`, `folder/panos`, not below.
class PictureFiles {
 public:
  /// Throws IoError when `folder` is no readable folder.
  explicit PictureFiles(const std::filesystem::path& folder);

  /// All pictures, in the order of the folders, then of the names.
  [[nodiscard]] const std::vector<std::filesystem::path>& all() const { return all_; }

  /// The picture that a pose file calls `name`: relative to `base`, then to the folders above, else
  /// the first picture with that file name. Empty when there is none.
  [[nodiscard]] std::filesystem::path Find(const std::string& name,
                                           const std::filesystem::path& base) const;

 private:
  std::vector<std::filesystem::path> folders_;
  std::vector<std::filesystem::path> all_;
  std::map<std::string, std::filesystem::path> by_file_name_;
};

}  // namespace enfilade
