#include <openssl/evp.h>

#include <array>
#include <memory>
#include <vector>

#include "io/image_file.h"
#include "io/input_file.h"

namespace heightlight {
namespace {

struct FreeDigest {
  void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};

std::string to_hexadecimal(const unsigned char* bytes, unsigned int count) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < count; ++i) {
    text += kDigits[bytes[i] >> 4];
    text += kDigits[bytes[i] & 15];
  }
  return text;
}

}  // namespace

std::string sha256_of_file(const std::filesystem::path& path) {
  const File file = open_input(path);
  const std::unique_ptr<EVP_MD_CTX, FreeDigest> context(EVP_MD_CTX_new());
  bool ok = context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
  std::vector<unsigned char> block(1 << 20);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
    ok = ok && EVP_DigestUpdate(context.get(), block.data(), count) == 1;
  }
  if (std::ferror(file.get())) throw file_error(path, "cannot be read to its end");
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  ok = ok && EVP_DigestFinal_ex(context.get(), digest.data(), &size) == 1;
  if (!ok) throw file_error(path, "its SHA-256 cannot be computed");
  return to_hexadecimal(digest.data(), size);
}

}  // namespace heightlight
