#include <openssl/evp.h>

#include <array>
#include <memory>
#include <vector>

#include "files/image_file.h"
#include "files/input_file.h"
#include "files/interrupt.h"

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

/// Computes one SHA-256 from data that arrive in pieces.
class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new()) {
    ok_ = context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1;
  }
  void add(const void* bytes, std::size_t count) {
    ok_ = ok_ && EVP_DigestUpdate(context_.get(), bytes, count) == 1;
  }
  std::string finish() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    ok_ = ok_ && EVP_DigestFinal_ex(context_.get(), digest.data(), &size) == 1;
    if (!ok_) throw Error("SHA-256 cannot be computed: OpenSSL's library fails");
    return to_hexadecimal(digest.data(), size);
  }

 private:
  std::unique_ptr<EVP_MD_CTX, FreeDigest> context_;
  bool ok_ = false;
};

}  // namespace

std::string sha256_of_file(const InputFile& file) {
  std::FILE* const stream = file.rewound();
  Sha256 sum;
  std::vector<unsigned char> block(1 << 20);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), stream)) {
    throw_if_interrupted();
    sum.add(block.data(), count);
  }
  if (std::ferror(stream)) throw file.error("cannot be read to its end");
  return sum.finish();
}

std::string sha256_of(std::string_view bytes) {
  Sha256 sum;
  sum.add(bytes.data(), bytes.size());
  return sum.finish();
}

}  // namespace heightlight
