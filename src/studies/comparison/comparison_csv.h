#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "comparison/compare_methods.h"

namespace heightlight {

/// "8 azimuths; samples per octave 8; cubic": how the table and plots name what stands in a row.
std::string parameters_and_variant(const ComparisonRow& row);

/// Writes `method,parameters,quantity,seconds,core_seconds,samples_per_texel,rmse,bias,p99,max,psnr`. Bent
/// normals are in degrees and have no psnr; samples_per_texel is empty where a method does not count them.
/// Throws Error naming the file.
void write_comparison_csv(const std::filesystem::path& path, const std::vector<ComparisonRow>& rows);

}  // namespace heightlight
