// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "enfilade/base/check.h"

namespace enfilade {

/// Executes statements on the database in a file, made where it is missing. Returns the last number
/// that they answer, 0 when there is none.
inline int64_t RunSql(const std::filesystem::path& path, const std::string& sql) {
  sqlite3* database = nullptr;
  ENFILADE_CHECK(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
  int64_t number = 0;
  const auto read = [](void* target, int, char** values, char**) {
    *static_cast<int64_t*>(target) = values[0] != nullptr ? std::stoll(values[0]) : 0;
    return 0;
  };
  const int code = sqlite3_exec(database, sql.c_str(), read, &number, nullptr);
  sqlite3_close(database);
  ENFILADE_CHECK(code == SQLITE_OK);
  return number;
}

}  // namespace enfilade
