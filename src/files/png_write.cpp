// stb's encoder, for this file alone; its names are not visible to a program that links this library.
// clang-tidy sees only the declarations: in the code, it reports an allocation of size 0 that cannot happen.
#ifndef __clang_analyzer__
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#endif
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include <cassert>

#include "files/image_file.h"
#include "files/output_file.h"

namespace heightlight {

void write_png(const std::filesystem::path& path, const Image<Rgb8>& picture) {
  static_assert(sizeof(Rgb8) == 3, "stb takes packed pixels");
  assert(picture.width > 0 && picture.height > 0);
  write_file(path, [&](std::FILE* stream) {
    const auto append = [](void* context, void* data, int size) {
      std::fwrite(data, 1, static_cast<std::size_t>(size), static_cast<std::FILE*>(context));
    };
    const int stride = picture.width * 3;
    if (!stbi_write_png_to_func(append, stream, picture.width, picture.height, 3, picture.values.data(),
                                stride)) {
      throw output_error(path, "no memory to compress it");
    }
  });
}

}  // namespace heightlight
