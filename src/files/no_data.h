#pragma once

#include <optional>
#include <string>

#include "heightlight/image.h"

namespace heightlight {

/// The value of the sample type ("uint8" … "double", "text") that is nearest to a no-data value given in
/// decimals. Numbers in text are treated as floats, which most of them once were. Empty where no sample can
/// be near that value.
std::optional<double> as_stored(double value, const std::string& sample_type);

/// Replaces by NaN the samples that equal `no_data` as the sample type stores it; returns how many were
/// replaced. A `no_data` beyond ±1e38, as written by programs that round the lowest float, matches every
/// sample beyond that limit on the same side.
std::size_t drop_no_data(double no_data, const std::string& sample_type, Image<double>& values);

/// Parses a number: "-9999", " +1e20", "nan". Empty for text that is not a number to its end ("-1.#IND",
/// "-3,4e38").
std::optional<double> parse_no_data(const std::string& text);

}  // namespace heightlight
