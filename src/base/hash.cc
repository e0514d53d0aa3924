// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/hash.h"

#include <openssl/evp.h>

#include <array>
#include <memory>

#include "enfilade/base/check.h"
#include "enfilade/base/file.h"

namespace enfilade {
namespace {

class Hasher {
 public:
  Hasher() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    ENFILADE_CHECK(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }
  void Add(std::string_view bytes) {
    ENFILADE_CHECK(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
  }
  std::string Finish() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    ENFILADE_CHECK(EVP_DigestFinal_ex(context_.get(), digest.data(), &size) == 1);
    static constexpr char kHex[] = "0123456789abcdef";
    std::string hex;
    for (unsigned int i = 0; i < size; ++i) hex += {kHex[digest[i] >> 4], kHex[digest[i] & 15]};
    return hex;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string Sha256(std::string_view bytes) {
  Hasher hasher;
  hasher.Add(bytes);
  return hasher.Finish();
}

std::string Sha256OfFile(const std::filesystem::path& path) {
  constexpr size_t kBlockBytes = size_t{1} << 18;
  const FileReader file(path);
  Hasher hasher;
  for (uint64_t offset = 0; offset < file.size(); offset += kBlockBytes) {
    hasher.Add(file.ReadAt(offset, kBlockBytes));
  }
  return hasher.Finish();
}

}  // namespace enfilade
