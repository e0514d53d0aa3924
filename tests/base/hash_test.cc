// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/hash.h"

#include <gtest/gtest.h>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

TEST(Sha256, VectorsOfTheStandard) {
  // NIST, FIPS 180-4 examples.
  EXPECT_EQ(Sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(Sha256(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256OfFile, EqualsSha256OfItsBytes) {
  const TempFolder folder;
  for (const size_t size : {size_t{0}, size_t{1}, size_t{1} << 18, (size_t{1} << 18) + 1}) {
    const std::string bytes(size, 'x');
    WriteFileAtomic(folder / "f", bytes);
    EXPECT_EQ(Sha256OfFile(folder / "f"), Sha256(bytes)) << size;
  }
}

TEST(Sha256OfFile, RefusesWhatIsNoFile) {
  const TempFolder folder;
  EXPECT_THROW((void)Sha256OfFile(folder / "missing"), IoError);
  EXPECT_THROW((void)Sha256OfFile(folder.path()), IoError);
}

}  // namespace
}  // namespace enfilade
