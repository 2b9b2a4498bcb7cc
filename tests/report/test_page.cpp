#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/hash.h"
#include "report/html_text.h"
#include "report/packed_levels.h"
#include "report/page.h"
#include "report/preview.h"

namespace heightlight {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const std::string kHostile = "</script><b>&\"'\n\x01\xff\u202e";

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// Noise, which hardly packs.
Map noisy_map(int width, int height) {
  Map map(width, height);
  for (std::size_t i = 0; i < map.size(); ++i)
    map.values[i] = static_cast<float>(unit_real(hash_combine(7, i)));
  return map;
}

PagePicture noisy_picture(int side) {
  const Map map = noisy_map(side, side);
  return {.name = "noise", .preview = make_preview({&map})};
}

Page hostile_page() {
  Page page{.title = kHostile,
            .what = kHostile,
            .asked = {{kHostile, kHostile}},
            .reached = {{kHostile, kHostile, Tone::bad}},
            .cost = {{kHostile, kHostile}},
            .command = kHostile,
            .inputs = {{kHostile, kHostile}},
            .warnings = {kHostile}};
  PagePicture picture = noisy_picture(4);
  picture.name = picture.about = picture.file = picture.unit = kHostile;
  picture.channels = {kHostile};
  page.groups = {{.title = kHostile, .about = kHostile, .pictures = {picture}}};
  page.charts = {{.title = kHostile,
                  .about = kHostile,
                  .x = kHostile,
                  .y = kHostile,
                  .curves = {{.name = kHostile, .points = {{0, 1}, {1, std::nan("")}}}}}};
  page.tables = {{.title = kHostile, .about = kHostile, .columns = {{kHostile}}, .rows = {{{kHostile}}}}};
  return page;
}

}  // namespace

TEST_CASE("texts of a page stay text", "[report]") {
  CHECK(html_text("<a href=\"x\">&'\n") == "&lt;a href=&quot;x&quot;&gt;&amp;&#39;\n");
  CHECK(html_text("\x01\xff\u202e") == "???");
  const nlohmann::ordered_json json = {{"</script>", kHostile}};
  const std::string script = script_json(json);
  CHECK(script.find('<') == std::string::npos);
  CHECK(nlohmann::json::parse(script).contains("</script>"));

  const std::string html = page_html(hostile_page());
  CHECK(count(html, "<b>") == 0);
  CHECK(count(html, "</script>") == 3);  // of the picture, of the chart, and the page's own
  CHECK(count(html, "\x01") == 0);
  CHECK(count(html, "\xff") == 0);
}

TEST_CASE("the same page has the same text, and lines of their own tell its cost", "[report]") {
  Page page = hostile_page();
  CHECK(page_html(page) == page_html(page));
  const std::string before = page_html(page);
  page.cost = {{"Time", "12 s"}};
  page.tables[0].columns.push_back({.name = "seconds", .of_cost = true});
  page.tables[0].rows[0].push_back(number_cell(12.3456));
  const std::string html = page_html(page);
  std::size_t told = 0;
  for (const std::string number : {"12 s", "12.35"}) {
    const std::size_t at = html.find(number);
    REQUIRE(at != std::string::npos);
    const std::size_t begin = html.rfind('\n', at) + 1;
    told += count(html.substr(begin, html.find('\n', at) - begin), "cost\"");
  }
  CHECK(told == 2);
}

TEST_CASE("pages keep to their limit, and say by what means", "[report]") {
  Page page{.title = "large"};
  page.groups = {{.title = "maps", .pictures = {noisy_picture(256), noisy_picture(256)}}};
  const std::size_t frame = page_html(page, 0).size();  // without pictures
  const std::string whole = page_html(page);
  CHECK(count(whole, "\"side\":1,") == 2);
  for (const std::size_t room : {200'000, 40'000, 9'000}) {
    const std::string html = page_html(page, frame + room);
    CHECK(html.size() <= frame + room);
    CHECK(html.size() > frame + room / 5);
    CHECK(count(html, "\"side\":1,") == 0);
    CHECK(count(html, "\"side\":") == 2);
  }
}

TEST_CASE("previews are means of cells, without missing samples", "[report]") {
  Map map(5, 3);
  for (std::size_t i = 0; i < map.size(); ++i) map.values[i] = static_cast<float>(i);
  map(0, 1) = kNan;
  map(2, 4) = kNan;
  const Preview same = make_preview({&map});
  CHECK(same.side == 1);
  const Preview half = make_preview({&map}, 3);
  CHECK(half.side == 2);
  REQUIRE(half.channels[0].width == 3);
  REQUIRE(half.channels[0].height == 2);
  CHECK(half.channels[0](0, 0) == Approx((0 + 5 + 6) / 3.0));
  CHECK(half.channels[0](0, 2) == Approx((4 + 9) / 2.0));
  CHECK(half.channels[0](1, 0) == Approx((10 + 11) / 2.0));
  CHECK(std::isnan(half.channels[0](1, 2)));
  const Preview coarse = coarsen(same, 2);
  CHECK(coarse.side == 2);
  CHECK(coarse.channels[0](0, 0) == half.channels[0](0, 0));

  // More rows than are read at once, channels side by side.
  const Map tall = noisy_map(3, 100);
  const Map other = noisy_map(3, 100);
  const Preview both = make_preview({&tall, &other});
  CHECK(both.channels[0] == tall);
  CHECK(both.channels[1] == other);

  const Preview picked = picked_preview(Map(3, 2, 0.5F), 5, 3, 2);
  CHECK(coarsen(picked, 2).channels[0].width == 2);
}

TEST_CASE("as many decimals as 16 bits and floats tell", "[report]") {
  const auto decimals = [](const std::vector<float>& values) {
    Map map(static_cast<int>(values.size()), 1);
    map.values = values;
    return choose_decimals({map});
  };
  CHECK(decimals({0, 1}) == 4);
  CHECK(decimals({0, 0.6F}) == 5);
  CHECK(decimals({0, 7}) == 3);
  CHECK(decimals({1000, 1200}) == 2);
  CHECK(decimals({0, 1e6F}) == -2);
  CHECK(decimals({0.5F, 0.5F}) == 6);
  CHECK(decimals({0, 0}) == 0);
  CHECK(decimals({kNan}) == 0);
  CHECK(decimals({std::numeric_limits<float>::infinity(), 0, 1}) == 4);
}

TEST_CASE("levels are counted from the least", "[report]") {
  Map map(2, 1);
  map.values = {-0.25F, kNan};
  CHECK(pack_levels(map, 2).base == -25);
  CHECK(pack_levels(map, 2).data != pack_levels(Map(2, 1, -0.25F), 2).data);
  CHECK(pack_levels(Map(2, 1, kNan), 0).base == 0);
}

}  // namespace heightlight
