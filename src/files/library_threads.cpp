#include "files/library_threads.h"

#include <OpenImageIO/imageio.h>

namespace heightlight {

void limit_library_threads(int threads) {
  OIIO::attribute("threads", threads);
  OIIO::attribute("exr_threads", threads);
}

}  // namespace heightlight
