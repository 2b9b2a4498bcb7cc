#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "heightlight/version.h"
#include "report/html_text.h"
#include "report/page.h"
#include "report/page_json.h"
#include "report/page_text.h"

namespace heightlight {
namespace {

/// Nothing may be loaded from anywhere: browsers hold the page to it.
constexpr std::string_view kHead =
    "<meta charset=\"utf-8\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
    "script-src 'unsafe-inline'\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<meta name=\"color-scheme\" content=\"light dark\">\n";

constexpr std::string_view kNoScript =
    "<noscript><p class=\"warning\">Pictures and curves need JavaScript, which this browser does not run. "
    "The evidence and the tables do without.</p></noscript>\n";

const char* class_of(Tone tone) {
  return tone == Tone::good ? " class=\"good\"" : tone == Tone::bad ? " class=\"bad\"" : "";
}

/// One line each, so that those of cost can be told from the others.
std::string facts_html(const std::vector<PageFact>& facts, bool of_cost) {
  std::string html;
  for (const PageFact& fact : facts) {
    html += fmt::format("<div{}><dt>{}</dt><dd{}>{}</dd></div>\n", of_cost ? " class=\"cost\"" : "",
                        html_text(fact.name), class_of(fact.tone), html_text(fact.value));
  }
  return html;
}

std::string card_html(const char* title, const std::vector<PageFact>& facts, bool of_cost = false) {
  if (facts.empty()) return "";
  return fmt::format("<section class=\"card\">\n<h2>{}</h2>\n<dl>\n{}</dl>\n</section>\n", title,
                     facts_html(facts, of_cost));
}

std::string repeat_html(const Page& page) {
  std::string html = "<section class=\"card wide\" id=\"repeat\">\n<h2>How to repeat it</h2>\n";
  if (!page.command.empty()) {
    html +=
        fmt::format("<div class=\"command\"><pre id=\"command\">{}</pre></div>\n", html_text(page.command));
  }
  html +=
      fmt::format("<p>With heightlight {}, in the folder that file names begin from", HEIGHTLIGHT_VERSION);
  html += page.inputs.empty()
              ? ".</p>\n"
              : ", and with these files:</p>\n<dl>\n" + facts_html(page.inputs, false) + "</dl>\n";
  return html +
         "<p class=\"note\">The results are the same to the last bit for any number of threads.</p>\n"
         "</section>\n";
}

std::string warnings_html(const std::vector<std::string>& warnings) {
  std::string html;
  for (const std::string& warning : warnings)
    html += fmt::format("<p class=\"warning\">Warning: {}</p>\n", html_text(warning));
  return html;
}

std::string cell_html(const PageCell& cell, bool of_cost) {
  const std::string number =
      cell.number ? fmt::format(" class=\"number\" data-number=\"{:.9g}\"", *cell.number) : "";
  const std::string text = html_text(cell.text);
  if (!of_cost) return fmt::format("<td{}>{}</td>", number, text);
  return fmt::format("\n<td{} data-is=\"cost\">{}</td>\n", number, text);
}

bool holds_numbers(const PageTable& table, std::size_t column) {
  return std::all_of(table.rows.begin(), table.rows.end(),
                     [column](const auto& row) { return row[column].number || row[column].text.empty(); });
}

constexpr std::size_t kPrintedRows = 60;  // as report.css has it

std::string table_html(const PageTable& table) {
  std::string html = fmt::format(
      "<section class=\"table\">\n<h2>{}</h2>\n<p>{}</p>\n<div class=\"scroll\">"
      "<table>\n<thead><tr>",
      html_text(table.title), html_text(table.about));
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    html += fmt::format("<th scope=\"col\"{}>{}</th>", holds_numbers(table, c) ? " class=\"number\"" : "",
                        html_text(table.columns[c].name));
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const std::vector<PageCell>& row : table.rows) {
    html += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) html += cell_html(row[c], table.columns.at(c).of_cost);
    html += "</tr>\n";
  }
  html += "</tbody>\n</table></div>\n";
  if (table.rows.size() > kPrintedRows)
    html += fmt::format("<p class=\"print-only\">The first {} of {} rows.</p>\n", kPrintedRows,
                        table.rows.size());
  return html + "</section>\n";
}

std::string chart_html(const PageChart& chart) {
  return fmt::format("<section class=\"chart\"><script type=\"application/json\"{}>{}</script></section>\n",
                     chart.of_cost ? " data-is=\"cost\"" : "", script_json(describe_chart(chart)));
}

std::string evidence_html(const Page& page) {
  return "<div class=\"cards\">\n" + card_html("What was asked", page.asked) +
         card_html("What was reached", page.reached) + card_html("What it cost", page.cost, true) +
         repeat_html(page) + "</div>\n";
}

/// All but the pictures, cut where these belong.
struct Frame {
  std::string before;
  std::string after;
};

Frame frame_html(const Page& page) {
  const std::string title = html_text(page.title);
  Frame frame;
  frame.before = fmt::format(
      "<!DOCTYPE html>\n<html "
      "lang=\"en\">\n<head>\n{}<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n"
      "<header>\n<h1>{}</h1>\n<p class=\"what\">{}</p>\n{}</header>\n<main>\n{}{}",
      kHead, title, kPageStyle, title, html_text(page.what), warnings_html(page.warnings),
      evidence_html(page), kNoScript);
  for (const PageChart& chart : page.charts) frame.after += chart_html(chart);
  for (const PageTable& table : page.tables) frame.after += table_html(table);
  frame.after += fmt::format(
      "</main>\n<footer>Made by heightlight {}. This file is complete in itself: it loads "
      "nothing.</footer>\n<script>\n{}</script>\n</body>\n</html>\n",
      HEIGHTLIGHT_VERSION, kPageScript);
  return frame;
}

PictureGroup coarsen(const PictureGroup& group, int times) {
  PictureGroup coarse = group;
  for (PagePicture& picture : coarse.pictures) picture.preview = coarsen(picture.preview, times);
  return coarse;
}

/// The pictures with cells of so many times the side; nothing where that takes more than `limit`.
std::optional<std::string> pictures_html(const std::vector<PictureGroup>& groups, int times,
                                         std::size_t limit) {
  std::string html;
  for (const PictureGroup& group : groups) {
    if (group.pictures.empty()) continue;
    const auto json = describe_group(times == 1 ? group : coarsen(group, times), limit - html.size());
    if (!json) return std::nullopt;
    html += "<section class=\"pictures\"><script type=\"application/json\">" + script_json(*json) +
            "</script></section>\n";
    if (html.size() > limit) return std::nullopt;
  }
  return html;
}

/// Above it, pictures have one cell.
int largest_side(const std::vector<PictureGroup>& groups) {
  int largest = 1;
  for (const PictureGroup& group : groups) {
    for (const PagePicture& picture : group.pictures) {
      for (const Map& channel : picture.preview.channels)
        largest = std::max({largest, channel.width, channel.height});
    }
  }
  return largest;
}

}  // namespace

PageCell number_cell(double value, int digits) {
  if (std::isnan(value)) return {};
  return {.text = fmt::format("{:.{}g}", value, digits), .number = value};
}

std::string page_html(const Page& page, std::size_t limit) {
  const Frame frame = frame_html(page);
  const std::size_t taken = frame.before.size() + frame.after.size();
  const std::size_t left = limit - std::min(limit, taken);
  const int last = largest_side(page.groups);
  for (int times = 1; times <= last; ++times) {
    if (const auto pictures = pictures_html(page.groups, times, left))
      return frame.before + *pictures + frame.after;
  }
  return frame.before + frame.after;
}

}  // namespace heightlight
