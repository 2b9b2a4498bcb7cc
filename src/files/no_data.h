#pragma once

#include <optional>
#include <string>

#include "heightlight/image.h"

namespace heightlight {

/// The value of the sample type ("uint8" … "double", "text") that stands for a no-data value given in
/// decimals: the nearest. Numbers in text are taken for floats, which most of them once were. Nothing where
/// no sample can be near it.
std::optional<double> as_stored(double value, const std::string& sample_type);

/// Makes NaN of the samples that are `no_data`, as stored; returns how many. What is beyond ±1e38, as
/// programs that round the lowest float write it, means every sample beyond on that side.
std::size_t drop_no_data(double no_data, const std::string& sample_type, Image<double>& values);

/// A number as text: "-9999", " +1e20", "nan". Nothing for what is not one to its end ("-1.#IND", "-3,4e38").
std::optional<double> parse_no_data(const std::string& text);

}  // namespace heightlight
