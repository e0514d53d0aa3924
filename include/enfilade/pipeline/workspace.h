// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace enfilade {

/// The result folder (OUT on the command line): the one place that knows where everything lies.
class Workspace {
 public:
  explicit Workspace(std::filesystem::path root) : root_(std::move(root)) {}

  [[nodiscard]] const std::filesystem::path& root() const { return root_; }
  [[nodiscard]] std::filesystem::path manifest_file() const { return root_ / "manifest.json"; }
  [[nodiscard]] std::filesystem::path scene_file() const { return root_ / "scene.json"; }
  /// What finding poses leaves: features of the pictures, or COLMAP's database of them.
  [[nodiscard]] std::filesystem::path sfm_folder() const { return root_ / "sfm"; }
  /// Which pictures see each other.
  [[nodiscard]] std::filesystem::path connections_folder() const { return root_ / "connections"; }
  /// How bright each view of a film is.
  [[nodiscard]] std::filesystem::path exposure_file() const { return root_ / "exposure.json"; }
  /// Poses and points for other programs.
  [[nodiscard]] std::filesystem::path sparse_folder() const { return root_ / "sparse"; }
  [[nodiscard]] std::filesystem::path points_file() const { return root_ / "points.ply"; }
  /// The dense cloud that was given, in the world of the scene.
  [[nodiscard]] std::filesystem::path cloud_file() const { return root_ / "cloud.bin"; }
  [[nodiscard]] std::filesystem::path structure_folder() const { return root_ / "structure"; }
  [[nodiscard]] std::filesystem::path evidence_folder() const { return root_ / "evidence"; }
  [[nodiscard]] std::filesystem::path floorplan_file() const { return root_ / "floorplan.json"; }
  [[nodiscard]] std::filesystem::path model_glb_file() const { return root_ / "model.glb"; }
  [[nodiscard]] std::filesystem::path model_obj_file() const { return root_ / "model.obj"; }
  [[nodiscard]] std::filesystem::path plan_svg_file() const { return root_ / "plan.svg"; }
  [[nodiscard]] std::filesystem::path evaluation_file() const { return root_ / "evaluation.json"; }
  [[nodiscard]] std::filesystem::path overlay_file() const { return root_ / "overlay.png"; }
  /// How the floorplan came about, as a page of pictures.
  [[nodiscard]] std::filesystem::path explain_svg_file() const { return root_ / "explain.svg"; }
  [[nodiscard]] std::filesystem::path explain_png_file() const { return root_ / "explain.png"; }
  [[nodiscard]] std::filesystem::path error_maps_folder() const { return root_ / "error_maps"; }
  /// Plans made without one panorama each, by which the run is checked against itself.
  [[nodiscard]] std::filesystem::path leave_one_out_folder() const {
    return root_ / "leave_one_out";
  }
  /// What rival methods make of the same structure, a folder each, and the page that compares them.
  [[nodiscard]] std::filesystem::path compare_folder() const { return root_ / "compare"; }
  /// The plan that the true wall profiles lead to.
  [[nodiscard]] std::filesystem::path perfect_folder() const { return root_ / "perfect"; }
  /// What 'enfilade why' draws of a wall; the storey stands in the name but for storey 0.
  [[nodiscard]] std::filesystem::path wall_svg_file(int storey_id, int wall_id) const {
    return root_ / (WallStem(storey_id, wall_id) + ".svg");
  }
  [[nodiscard]] std::filesystem::path wall_png_file(int storey_id, int wall_id) const {
    return root_ / (WallStem(storey_id, wall_id) + ".png");
  }
  [[nodiscard]] std::filesystem::path lock_file() const { return root_ / ".lock"; }

 private:
  [[nodiscard]] static std::string WallStem(int storey_id, int wall_id) {
    const std::string storey = storey_id == 0 ? "" : std::to_string(storey_id) + "_";
    return "why_" + storey + std::to_string(wall_id);
  }

  std::filesystem::path root_;
};

enum class WorkspaceUse {
  kCreate,    ///< the folder is made when it is absent
  kExisting,  ///< the folder must hold a manifest: a stage, evaluate
};

/// Exclusive use of a result folder, so that two runs cannot mix their files. Held until the end of
/// the scope; the system releases it when the process dies, however it dies.
class WorkspaceLock {
 public:
  /// Makes or checks the folder, locks it and removes the temporary files of a killed run.
  ///
  /// Throws InvalidInputError when the folder holds something else than a result of this program,
  /// or is to exist and has no manifest; IoError when it cannot be made, is not writable or is
  /// locked by another process.
  WorkspaceLock(const Workspace& workspace, WorkspaceUse use);
  ~WorkspaceLock();
  WorkspaceLock(const WorkspaceLock&) = delete;
  WorkspaceLock& operator=(const WorkspaceLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// The regular files at or below the given paths (relative to the root), relative to the root and
/// sorted; paths that do not exist are left out.
[[nodiscard]] std::vector<std::filesystem::path> ListFiles(
    const Workspace& workspace, const std::vector<std::filesystem::path>& relative_paths);

/// Removes the given files or folders (relative to the root) where they exist. Throws IoError.
void RemoveFiles(const Workspace& workspace,
                 const std::vector<std::filesystem::path>& relative_paths);

}  // namespace enfilade
