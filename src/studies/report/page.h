#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "report/preview.h"

// What a report tells, as plain data: page_html makes a file of it.

namespace heightlight {

/// How a fact is to be taken.
enum class Tone { plain, good, bad };

/// One line of evidence: "RMSE of the sky view factor", "0.0013".
struct PageFact {
  std::string name = {};
  std::string value = {};
  Tone tone = Tone::plain;
};

/// How values become colours.
enum class PictureKind {
  light,     ///< linear, 0 black: encoded as sRGB
  plain,     ///< from the least value, black, to the greatest, white
  error,     ///< blue below 0, red above
  direction  ///< components from −1 to 1
};

struct PagePicture {
  std::string name = {};   ///< of its tab
  std::string about = {};  ///< a sentence that says what it is
  std::string file = {};   ///< of the results, that holds these values; empty: none does
  std::string unit = {};
  PictureKind kind = PictureKind::light;
  std::vector<std::string> channels = {"Y"};  ///< one, or three
  Preview preview = {};
};

/// Pictures of one map, which flip at the same place.
struct PictureGroup {
  std::string title = {};
  std::string about = {};
  std::vector<PagePicture> pictures = {};
  std::optional<std::size_t> reference = {};  ///< the picture from which the others' errors are counted
};

struct PageCurve {
  std::string name = {};
  std::vector<std::array<double, 2>> points = {};  ///< lines break where y is NaN
  std::vector<std::string> labels = {};  ///< of the points, for their read-out; none, or one for each
  bool shown = true;                     ///< at first
  bool dashed = false;
  std::optional<std::size_t> colour = {};  ///< curves of one number share it; empty: the curve's own
};

struct PageChart {
  std::string title = {};
  std::string about = {};
  std::string x = {};
  std::string y = {};
  std::vector<PageCurve> curves = {};
  bool log_x = false;
  bool log_y = false;
  bool dots = false;     ///< points stand for themselves
  bool ordered = false;  ///< curves follow one on another, and so do their colours
  bool of_cost = false;  ///< it tells seconds
};

/// A text, or a number with its text, by which rows are sorted.
struct PageCell {
  std::string text = {};
  std::optional<double> number = {};
};

/// A cell of a number, to so many significant digits; empty where it is NaN.
PageCell number_cell(double value, int digits = 4);

struct PageColumn {
  std::string name = {};
  bool of_cost = false;  ///< it tells seconds
};

struct PageTable {
  std::string title = {};
  std::string about = {};
  std::vector<PageColumn> columns = {};
  std::vector<std::vector<PageCell>> rows = {};  ///< a cell for each column
};

/// A report. All texts may hold anything: they stay text.
struct Page {
  std::string title = {};  ///< what it is about: a map's name
  std::string what = {};   ///< a paragraph that says what this is
  std::vector<PageFact> asked = {};
  std::vector<PageFact> reached = {};
  std::vector<PageFact> cost = {};
  std::string command = {};           ///< that makes it again, as a shell reads it
  std::vector<PageFact> inputs = {};  ///< files that were read, and their SHA-256
  std::vector<std::string> warnings = {};
  std::vector<PictureGroup> groups = {};
  std::vector<PageChart> charts = {};
  std::vector<PageTable> tables = {};
};

/// No page has more bytes, unless its texts and tables alone do.
constexpr std::size_t kPageLimit = 10'000'000;

/// One self-contained file of HTML. All previews get coarser, alike, until the page keeps to the limit; it
/// says how much. The same page gives the same text; lines with `cost"` in them tell what differs from one
/// run to the next.
std::string page_html(const Page& page, std::size_t limit = kPageLimit);

}  // namespace heightlight
