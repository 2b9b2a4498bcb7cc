#include "shaders/text_template.h"

namespace heightlight {
namespace {

bool is_name(char character) {
  return (character >= 'a' && character <= 'z') || character == '_' || (character >= '0' && character <= '9');
}

}  // namespace

std::string fill_in(const std::string& text, const Replacements& replacements) {
  std::string filled;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '$') {
      filled += text[i++];
      continue;
    }
    std::size_t end = i + 1;
    while (end < text.size() && is_name(text[end])) ++end;
    const std::string name = text.substr(i + 1, end - i - 1);
    for (const auto& [known, value] : replacements) {
      if (known == name) filled += value;
    }
    i = end;
  }
  return filled;
}

}  // namespace heightlight
