#include <catch2/catch.hpp>
#include <fstream>
#include <string>

#include "base/byte_size.h"
#include "base/machine_share.h"

namespace heightlight {

TEST_CASE("OMP_NUM_THREADS is a number, or a list whose first counts", "[base]") {
  CHECK(parse_thread_setting("4") == 4);
  CHECK(parse_thread_setting(" 3 ") == 3);
  CHECK(parse_thread_setting("8,2") == 8);
  for (const char* text : {"", "0", "-2", "many", "4x", "99999999999"}) {
    INFO(text);
    CHECK(!parse_thread_setting(text));
  }
  CHECK(!parse_thread_setting(nullptr));
}

TEST_CASE("what the process holds is less than it held at most, and than it may take", "[base]") {
  const std::uint64_t before = resident_memory();
  const std::string touched(64 << 20, 'x');
  CHECK(resident_memory() > before + (60 << 20));
  CHECK(peak_memory() >= resident_memory());
  CHECK(touched[before % touched.size()] == 'x');
  CHECK(default_threads() >= 1);
  CHECK(default_memory(1) > 0);
}

TEST_CASE("an amount that is enough is written as it is read", "[base]") {
  CHECK(write_enough(1) == "1M");
  CHECK(write_enough(412 << 20) == "412M");
  CHECK(write_enough((412 << 20) + 1) == "413M");
  CHECK(parse_byte_size(write_enough(5'000'000'000)) >= 5'000'000'000);
}

}  // namespace heightlight
