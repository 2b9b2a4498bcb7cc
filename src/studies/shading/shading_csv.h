#pragma once

#include <filesystem>
#include <vector>

#include "heightlight/image.h"
#include "shading/directional_study.h"
#include "shading/specular_study.h"

namespace heightlight {

/// Degrees that a view is above the horizontal.
double elevation_deg(const Vector3& view);

/// Tables of the studies, a line each below a head. All throw Error naming the file.
void write_specular_csv(const std::filesystem::path& path, const SpecularStudy& study,
                        const std::vector<Vector3>& views);
void write_directional_csv(const std::filesystem::path& path, const DirectionalStudy& study);
void write_cone_forms_csv(const std::filesystem::path& path, const std::vector<ConeFormError>& forms);

}  // namespace heightlight
