#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "heightlight/curves.h"
#include "heightlight/error.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/curve_table.h"
#include "python/python_watch.h"

namespace heightlight {
namespace {

/// Makes curves from bounces without keeping the bounces.
class CurveSink : public BounceSink {
 public:
  explicit CurveSink(int bins) : bins_(bins) {}

  void take_sky(const Map& ambient_occlusion, const Map& sky_view_factor) override {
    builders_.emplace_back(ambient_occlusion, AoKind::ambient_occlusion, bins_);
    builders_.emplace_back(sky_view_factor, AoKind::sky_view_factor, bins_);
  }
  void take_bounce(int, const TexelVector& irradiance) override {
    for (CurveBuilder& builder : builders_) builder.add(irradiance);
  }
  void take_tail(const TexelVector& tail) override {
    for (CurveBuilder& builder : builders_) builder.add_tail(tail);
  }

  std::vector<BounceCurves> curves() const { return {builders_.at(0).curves(), builders_.at(1).curves()}; }

 private:
  int bins_;
  std::vector<CurveBuilder> builders_;
};

/// The operator F of one surface, found once.
class Operator {
 public:
  /// Plans for the user's own direct irradiance, one map per channel, or for that of an even sky if there is
  /// none.
  Operator(SharedSurface surface, Settings settings, const std::vector<Array<double>>& direct)
      : surface_(std::move(surface)), settings_(std::move(settings)) {
    Request request = make_request(settings_);
    request.wanted.direct = read_direct(direct);
    PythonWatch watch(settings_.progress);
    request.watch = watch.for_longer();
    found_ = watch.run([&](const Watch&) { return find_operator(*surface_, request); });
  }

  const Map& present() const { return found_.transport->sky_view_factor; }

  py::array_t<double> direct() const { return take_texels(found_.transport->direct, present()); }
  py::array_t<float> sky_view_factor() const { return take_map(present()); }
  py::array_t<float> ambient_occlusion() const { return take_map(found_.transport->ambient_occlusion); }

  /// F x; 0 where the sample is missing.
  py::array_t<double> gather(const Array<double>& values) const {
    check_shape(values, "irradiance", surface_->height(), surface_->width());
    const TexelVector texels = read_texels(values);
    if (std::any_of(texels.begin(), texels.end(), [](double value) { return !std::isfinite(value); }))
      throw UsageError("irradiance", "", "must be finite; NaN means missing");
    PythonWatch watch{py::none()};
    const ThreadScope threads(settings_.threads);
    return take_array(watch.run([&](const Watch&) { return found_.transport->gather(texels); }),
                      {surface_->height(), surface_->width()});
  }

  /// (bounces E₀ … E_K, tail, evidence), as E/π at ρ = 1.
  py::tuple bounces(int count) const {
    if (count < 1) throw UsageError("bounces", std::to_string(count), "must be from 1 to 1000");
    Request request = lent_request();
    request.wanted.bounces = count;
    Results results = run(request);
    py::list all;
    for (TexelVector& bounce : results.bounces) all.append(take_texels(std::move(bounce), present()));
    return py::make_tuple(all, take_texels(std::move(results.tail), present()),
                          evidence_text(results.evidence));
  }

  /// (E/π per channel, evidence). `varying` has an array per channel if `constant` is empty.
  py::tuple solve_total(const std::vector<double>& constant, const std::vector<Array<double>>& varying,
                        const std::vector<Array<double>>& direct) const {
    Request request = lent_request();
    Albedo& albedo = request.wanted.totals.emplace_back();
    albedo.constant = constant;
    for (const Array<double>& channel : varying) {
      check_shape(channel, "albedo", surface_->height(), surface_->width());
      albedo.varying.push_back(read_texels(channel));
    }
    request.wanted.direct = read_direct(direct);
    Results results = run(request);
    py::list channels;
    for (TexelVector& channel : results.totals[0])
      channels.append(take_texels(std::move(channel), present()));
    return py::make_tuple(channels, evidence_text(results.evidence));
  }

  /// E/π at each of several constant albedos, found together.
  py::tuple totals(const std::vector<double>& albedos) const {
    Request request = lent_request();
    for (const double albedo : albedos) request.wanted.totals.push_back({.constant = {albedo}});
    Results results = run(request);
    py::list found;
    for (std::vector<TexelVector>& total : results.totals)
      found.append(take_texels(std::move(total[0]), present()));
    return py::make_tuple(found, evidence_text(results.evidence));
  }

  /// n of every texel.
  py::array_t<float> seen() const {
    Request request = lent_request();
    request.wanted.seen = true;
    return take_map(std::move(run(request).seen));
  }

  /// Curves over α and over A, s, and the mean of n.
  py::tuple curves(int bins, int bounces) const {
    if (bounces < 1) throw UsageError("bounces", std::to_string(bounces), "must be from 1 to 1000");
    if (bins < 1 || bins > 10000) throw UsageError("bins", std::to_string(bins), "must be from 1 to 10000");
    CurveSink sink(bins);
    Request request = lent_request();
    request.wanted.bounces = bounces;
    request.sink = &sink;
    const Results results = run(request);
    const std::vector<BounceCurves> found = sink.curves();
    const SeenSky& seen = *results.evidence.seen;
    return py::make_tuple(curve_table(found[0]), curve_table(found[1]), seen.expected, seen.mean);
  }

 private:
  /// Converts one map per channel.
  std::vector<TexelVector> read_direct(const std::vector<Array<double>>& direct) const {
    std::vector<TexelVector> channels;
    for (const Array<double>& channel : direct) {
      check_shape(channel, "direct", surface_->height(), surface_->width());
      channels.push_back(read_texels(channel));
    }
    return channels;
  }

  Request lent_request() const {
    Request request = make_request(settings_);
    request.transport = &found_;
    request.checks.energy = request.checks.bounces = false;
    return request;
  }

  Results run(Request& request) const {
    PythonWatch watch(settings_.progress);
    return watch.run([&](const Watch& told) {
      request.watch = told;
      return solve(*surface_, request);
    });
  }

  SharedSurface surface_;
  Settings settings_;
  PlannedTransport found_;
};

}  // namespace

void add_operator(py::module_& module) {
  py::class_<Operator>(module, "Operator")
      .def(py::init([](const std::shared_ptr<Surface>& surface, const Settings& settings,
                       const std::vector<Array<double>>& direct) {
             return std::make_unique<Operator>(surface, settings, direct);
           }),
           py::arg("surface"), py::arg("settings"), py::arg("direct"))
      .def_property_readonly("direct", &Operator::direct)
      .def_property_readonly("sky_view_factor", &Operator::sky_view_factor)
      .def_property_readonly("ambient_occlusion", &Operator::ambient_occlusion)
      .def("gather", &Operator::gather, py::arg("irradiance"))
      .def("bounces", &Operator::bounces, py::arg("count"))
      .def("solve", &Operator::solve_total, py::arg("constant"), py::arg("varying"), py::arg("direct"))
      .def("totals", &Operator::totals, py::arg("albedos"))
      .def("seen", &Operator::seen)
      .def("curves", &Operator::curves, py::arg("bins"), py::arg("bounces"));
}

}  // namespace heightlight
