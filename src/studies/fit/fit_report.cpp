#include "fit/fit_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/digits.h"
#include "files/evidence_json.h"
#include "heightlight/version.h"

namespace heightlight {
namespace {

using Json = nlohmann::ordered_json;

std::vector<double> to_vector(const Eigen::VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

Json describe_map(const JudgedMap& map, const std::filesystem::path& curves) {
  Json json = {{"name", map.name},
               {"material", map.material},
               {"curves", curves.string()},
               {"bins",
                {{"ambient_occlusion", map.over_alpha.filled.size()},
                 {"sky_view_factor", map.over_sky.filled.size()}}},
               {"bounces", map.over_alpha.filled.front().bounces.size() - 1},
               {"texels", map.texels ? map.texels->size() : 0}};
  if (map.expected_seen) {
    json["seen"] = {{"expected_sky_view_factor", *map.expected_seen},
                    {"mean_sky_view_factor", *map.measured_seen},
                    {"resolved", is_resolved(map)}};
  }
  return json;
}

Json describe_family(const FittedFamily& fitted) {
  const FormFamily& family = *fitted.family;
  const std::string start = origin_of_constants(family);
  Json parameters = Json::array();
  for (std::size_t p = 0; p < family.parameters.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    parameters.push_back({{"name", family.parameters[p]},
                          {"value", fitted.fit.parameters[i]},
                          {start, family.published[p]},
                          {"standard_error", std::sqrt(fitted.fit.covariance(i, i))},
                          {"low", fitted.intervals.low[i]},
                          {"high", fitted.intervals.high[i]},
                          {"determined", is_determined(family, fitted.fit.parameters, fitted.intervals, i)}});
  }
  Json covariance = Json::array();
  for (Eigen::Index row = 0; row < fitted.fit.covariance.rows(); ++row) {
    covariance.push_back(to_vector(fitted.fit.covariance.row(row)));
  }
  return {
      {"name", family.name},
      {"formula", family.formula},
      {"source", family.source},
      {"ao_kind", to_string(family.kind)},
      {"parameters", parameters},
      {"covariance", covariance},
      {"rms", fitted.fit.rms},
      {std::string("rms_as_") + start, fitted.published_rms},
      {"bootstrap", {{"drawn", fitted.intervals.unit}, {"draws", fitted.intervals.draws}, {"share", 0.95}}}};
}

Json describe_bounce_fit(const BounceFit& fit) {
  if (!fit.fault.empty()) return {{"bounce", fit.bounce}, {"fault", fit.fault}};
  constexpr const char* kNames[] = {"A", "B", "C"};
  Json constants = Json::array();
  for (std::size_t c = 0; c < 3; ++c)
    constants.push_back(
        {{"name", kNames[c]}, {"value", fit.constants[c]}, {"low", fit.low[c]}, {"high", fit.high[c]}});
  return {{"bounce", fit.bounce}, {"constants", constants}, {"rms", fit.rms}, {"peak", fit.peak}};
}

Json describe_cubics(const std::vector<AlbedoCubic>& cubics) {
  Json json = Json::array();
  for (const AlbedoCubic& cubic : cubics) {
    json.push_back(
        {{"albedo", cubic.albedo}, {"a", cubic.a}, {"b", cubic.b}, {"c", cubic.c}, {"rms", cubic.rms}});
  }
  return json;
}

Json describe_forms(const std::vector<JudgedForm>& forms) {
  Json json = Json::array();
  for (const JudgedForm& form : forms) {
    Json errors = Json::array();
    for (std::size_t k = 0; k < form.errors.size(); ++k) {
      errors.push_back({{"albedo", judged_albedos()[k]},
                        {"rms", form.errors[k].rms()},
                        {"bias", form.errors[k].bias()},
                        {"max", form.errors[k].largest}});
    }
    json.push_back({{"name", form.name},
                    {"formula", form.formula},
                    {"source", form.source},
                    {"ao_kind", to_string(form.kind)},
                    {"fitted_without_the_material", form.fitted},
                    {"outside_domain", form.outside_share},
                    {"errors", errors}});
  }
  return json;
}

void append_forms(const std::vector<JudgedForm>& forms, const char* unit, std::string& text) {
  for (const JudgedForm& form : forms) {
    for (std::size_t k = 0; k < form.errors.size(); ++k) {
      text += form.name + (form.fitted ? ",1," : ",0,") + unit + ',' + in_digits(judged_albedos()[k]) + ',' +
              in_digits(form.errors[k].rms()) + ',' + in_digits(form.errors[k].bias()) + ',' +
              in_digits(form.errors[k].largest) + '\n';
    }
  }
}

}  // namespace

const FittedFamily* find_family(const FitReport& report, const std::string& name) {
  for (const FittedFamily& fitted : report.families) {
    if (fitted.family->name == name) return &fitted;
  }
  return nullptr;
}

std::string report_json(const FitReport& report) {
  Json json;
  json["version"] = HEIGHTLIGHT_VERSION;
  json["files"] = describe_files(report.files);
  json["seed"] = report.seed;
  json["maps"] = Json::array();
  for (std::size_t i = 0; i < report.maps.size(); ++i) {
    json["maps"].push_back(describe_map(report.maps[i], report.inputs[i]));
  }
  json["families"] = Json::array();
  for (const FittedFamily& fitted : report.families) json["families"].push_back(describe_family(fitted));
  json["cubic_by_albedo"] = {{"three_bounces", describe_cubics(report.cubics_three_bounces)},
                             {"all_bounces", describe_cubics(report.cubics_all_bounces)}};
  json["bounces"] = {{"formula", "E_b/pi = A alpha (1 - alpha)^1.5 exp(-B alpha^C)"},
                     {"fits", Json::array()}};
  for (const BounceFit& fit : report.bounce_fits) json["bounces"]["fits"].push_back(describe_bounce_fit(fit));
  json["ratios"] = Json::array();  // bin by bin in ratios.csv
  for (const BounceRatios& ratios : report.ratios)
    json["ratios"].push_back({{"map", ratios.map}, {"spread", ratios.spread}});
  json["cross_validation"] = {{"left_out", report.trial.materials > 1 ? "material" : "nothing"},
                              {"materials", report.trial.materials},
                              {"per_texel", describe_forms(report.trial.per_texel)},
                              {"per_texel_resolved", describe_forms(report.trial.per_texel_resolved)},
                              {"per_bin", describe_forms(report.trial.per_bin)}};
  json["floors"] = Json::array();
  for (const Floor& floor : report.floors) {
    json["floors"].push_back({{"inputs", floor.inputs}, {"albedos", judged_albedos()}, {"rms", floor.rms}});
  }
  return json_text(json);
}

std::string ratios_csv(const FitReport& report) {
  std::size_t most = 0;
  for (const BounceRatios& ratios : report.ratios) {
    for (const RatioBin& bin : ratios.bins) most = std::max(most, bin.ratios.size());
  }
  const auto field = [](double value) { return std::isnan(value) ? "," : ',' + in_digits(value, 6); };
  std::string text = "map,alpha,texels,tau,tau_published";
  for (std::size_t b = 1; b <= most; ++b) text += ",E" + std::to_string(b + 1) + "/E" + std::to_string(b);
  text += '\n';
  for (const BounceRatios& ratios : report.ratios) {
    for (const RatioBin& bin : ratios.bins) {
      text += ratios.map + field(bin.ao) + ',' + std::to_string(bin.count) + field(bin.by_conservation) +
              field(bin.published);
      for (std::size_t b = 0; b < most; ++b) text += b < bin.ratios.size() ? field(bin.ratios[b]) : ",";
      text += '\n';
    }
  }
  return text;
}

std::string report_csv(const FitReport& report) {
  std::string text = "model,fitted,unit,albedo,rms,bias,max\n";
  append_forms(report.trial.per_texel, "texel", text);
  append_forms(report.trial.per_texel_resolved, "texel_resolved", text);
  append_forms(report.trial.per_bin, "bin", text);
  for (const Floor& floor : report.floors) {
    for (std::size_t k = 0; k < floor.rms.size(); ++k) {
      text += "floor of " + floor.inputs + ",1,texel," + in_digits(judged_albedos()[k]) + ',' +
              in_digits(floor.rms[k]) + ",0,\n";
    }
  }
  return text;
}

}  // namespace heightlight
