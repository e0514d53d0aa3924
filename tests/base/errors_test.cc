// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/errors.h"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(UserError, IsWhereProblemCure) {
  EXPECT_STREQ(IoError("a.jpg", "cannot be opened", "check the path").what(),
               "a.jpg: cannot be opened; check the path");
  EXPECT_STREQ(InvalidInputError("--threads", "is -1", "").what(), "--threads: is -1");
}

TEST(UserError, IsOnePrintableLine) {
  const InvalidInputError error("a\nb\x1b[31m\x7f", std::string("bad \xff\0 byte", 11), "x\r");
  EXPECT_STREQ(error.what(), "a\\x0ab\\x1b[31m\\x7f: bad \\xff\\x00 byte; x\\x0d");
}

TEST(UserError, KindsAreTold) {
  // Callers tell input from environment by type.
  EXPECT_THROW(throw IoError("a", "b", "c"), UserError);
  EXPECT_THROW(throw DependencyError("a", "b", "c"), UserError);
  EXPECT_THROW(throw StoppedError(), std::runtime_error);
}

TEST(PrintablePath, KeepsUtf8AndEscapesTheRest) {
  EXPECT_EQ(PrintablePath("salle à manger/π.jpg"), "salle à manger/π.jpg");
  EXPECT_EQ(PrintablePath("caf\xe9.jpg"), "caf\\xe9.jpg");
  EXPECT_EQ(PrintablePath("a\tb"), "a\\x09b");
  EXPECT_EQ(PrintablePath(""), "");
}

struct Utf8Case {
  std::string_view bytes;
  bool is_valid;
};

TEST(IsValidUtf8, FollowsRfc3629) {
  // Table 3-7 of the Unicode standard, at its borders.
  const Utf8Case cases[] = {
      {"", true},
      {"plain", true},
      {"\x7f", true},
      {"\xc2\x80", true},           // U+0080
      {"\xdf\xbf", true},           // U+07FF
      {"\xe0\xa0\x80", true},       // U+0800
      {"\xed\x9f\xbf", true},       // U+D7FF
      {"\xee\x80\x80", true},       // U+E000
      {"\xef\xbf\xbf", true},       // U+FFFF
      {"\xf0\x90\x80\x80", true},   // U+10000
      {"\xf4\x8f\xbf\xbf", true},   // U+10FFFF
      {"\x80", false},              // continuation alone
      {"\xc0\xaf", false},          // overlong '/'
      {"\xc1\xbf", false},          // overlong
      {"\xe0\x9f\xbf", false},      // overlong
      {"\xed\xa0\x80", false},      // surrogate
      {"\xf0\x8f\xbf\xbf", false},  // overlong
      {"\xf4\x90\x80\x80", false},  // above U+10FFFF
      {"\xf5\x80\x80\x80", false},
      {"\xff", false},
      {"a\xe2\x82", false},     // cut off
      {"\xe2\x82\x28", false},  // wrong continuation
      {"\xc2", false},
  };
  for (const Utf8Case& c : cases) {
    EXPECT_EQ(IsValidUtf8(c.bytes), c.is_valid) << PrintablePath(std::string(c.bytes));
  }
}

}  // namespace
}  // namespace enfilade
