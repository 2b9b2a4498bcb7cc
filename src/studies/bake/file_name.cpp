#include "bake/file_name.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "heightlight/error.h"

namespace heightlight {

std::string fill_placeholders(const std::string& quantity, const std::string& text,
                              const Placeholders& values) {
  std::string filled;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('{', at);
    filled += text.substr(at, open - at);
    if (open == std::string::npos) break;
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) throw UsageError(quantity, text, "a { is not closed");
    const auto found = values.find(text.substr(open + 1, close - open - 1));
    if (found == values.end()) {
      std::string known;
      for (const auto& [name, ignored] : values) known += (known.empty() ? "{" : ", {") + name + "}";
      throw UsageError(
          quantity, text,
          "there is no placeholder " + text.substr(open, close - open + 1) + " (known: " + known + ")");
    }
    filled += found->second;
    at = close + 1;
  }
  return filled;
}

std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words(1);
  bool after_small = false;
  for (const unsigned char c : name) {
    if (std::isalnum(c) == 0 || (std::isupper(c) != 0 && after_small)) words.emplace_back();
    if (std::isalnum(c) != 0) words.back() += static_cast<char>(std::tolower(c));
    after_small = std::islower(c) != 0;
  }
  return words;
}

bool is_word_for_heights(const std::string& word) {
  static const std::set<std::string> kWords{"height",       "heights", "heightmap", "disp",
                                            "displacement", "bump",    "depth",     "elevation",
                                            "dem",          "dsm",     "dtm",       "terrain"};
  return kWords.contains(word);
}

std::string material_name(const std::string& stem) {
  const auto is_no_word = [](unsigned char c) { return std::isalnum(c) == 0; };
  const auto parting = std::find_if(stem.rbegin(), stem.rend(), is_no_word);
  if (parting == stem.rend() || parting + 1 == stem.rend()) return stem;
  const std::string word(parting.base(), stem.end());
  const std::size_t letters = word.find_last_not_of("0123456789") + 1;
  const std::vector<std::string> words = words_of(word.substr(0, letters));
  if (words.size() != 1 || !is_word_for_heights(words[0])) return stem;
  return {stem.begin(), parting.base() - 1};
}

}  // namespace heightlight
