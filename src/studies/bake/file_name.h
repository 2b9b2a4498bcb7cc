#pragma once

#include <map>
#include <string>
#include <vector>

namespace heightlight {

/// What stands in a text for what differs from map to map, without the braces: {"stem", "rock_height"}.
using Placeholders = std::map<std::string, std::string>;

/// A text with its placeholders, {stem}, filled in. `quantity` is the option that the text is of. Throws
/// UsageError for a placeholder that is not known, or a brace that is not closed.
std::string fill_placeholders(const std::string& quantity, const std::string& text,
                              const Placeholders& values);

/// Words of a name, in small letters: parted by what is no letter or digit, and where a capital follows a
/// small letter.
std::vector<std::string> words_of(const std::string& name);

/// Whether a word (small letters) says that a map holds heights: height, displacement, dem …
bool is_word_for_heights(const std::string& word);

/// The stem of a heightmap's file without the last word that says that it holds heights, and without digits
/// behind that: "Bricks102" of "Bricks102_height16"; the stem itself where it ends otherwise.
std::string material_name(const std::string& stem);

}  // namespace heightlight
