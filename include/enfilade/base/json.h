// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace enfilade {

/// Reads and parses a JSON file. Throws IoError, or InvalidInputError with the line of the first
/// syntax error, or when a number is too large for a double; files over `max_bytes` are refused.
[[nodiscard]] nlohmann::json ReadJsonFile(const std::filesystem::path& path,
                                          uint64_t max_bytes = uint64_t{1} << 28);

/// Writes atomically, two-space indented, arrays of plain values on one line, keys sorted, numbers
/// in shortest form that reads back the same, strings that are no UTF-8 with the bad bytes
/// replaced. Throws IoError.
void WriteJsonFile(const std::filesystem::path& path, const nlohmann::json& json);

/// Typed access that tells the user which key of which file is at fault. `where` is the file.
///
/// Each throws InvalidInputError when the key is missing, of another type or not finite.
[[nodiscard]] double JsonNumber(const nlohmann::json& object, const char* key,
                                const std::string& where);
[[nodiscard]] int64_t JsonInteger(const nlohmann::json& object, const char* key,
                                  const std::string& where);
[[nodiscard]] std::string JsonString(const nlohmann::json& object, const char* key,
                                     const std::string& where);
[[nodiscard]] const nlohmann::json& JsonArray(const nlohmann::json& object, const char* key,
                                              const std::string& where);
[[nodiscard]] const nlohmann::json& JsonObject(const nlohmann::json& object, const char* key,
                                               const std::string& where);

}  // namespace enfilade
