// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace enfilade {

/// Common head of the errors that a user can mend. what() is one line: "where: problem; cure".
class UserError : public std::runtime_error {
 public:
  /// `where` is the file, folder or option at fault; `problem` what is wrong with it; `cure` what
  /// to do. The three are joined into one printable line (control characters are escaped).
  UserError(const std::string& where, const std::string& problem, const std::string& cure);
};

/// The content of a file or the value of an option is wrong: missing field, wrong type, NaN, …
class InvalidInputError : public UserError {
 public:
  using UserError::UserError;
};

/// A file cannot be read or written: missing, unreadable, read-only, disk full.
class IoError : public UserError {
 public:
  using UserError::UserError;
};

/// A program or library that the work needs is absent or refuses.
class DependencyError : public UserError {
 public:
  using UserError::UserError;
};

/// The run was asked to stop (signal or RunContext::RequestStop). Finished stages are kept.
class StoppedError : public std::runtime_error {
 public:
  StoppedError() : std::runtime_error("stopped on request") {}
};

/// The path as printable UTF-8: bytes that are no valid UTF-8 or that are control characters
/// appear as \xNN. For messages and reports, not for opening files.
[[nodiscard]] std::string PrintablePath(const std::filesystem::path& path);

/// True when the bytes are well-formed UTF-8 (no overlong forms, no surrogates).
[[nodiscard]] bool IsValidUtf8(std::string_view bytes);

}  // namespace enfilade
