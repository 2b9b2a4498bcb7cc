#include "gloss/cone_share.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace heightlight {

ConeLobe make_cone_lobe(const Gloss& gloss, double view_angle, int count, const LatticeShift& shift) {
  constexpr double kLeastCosine = 1e-3;  // along the surface there is no lobe
  const double cosine = std::max(std::cos(view_angle), kLeastCosine);
  std::vector<LobeSample> samples;
  sample_ggx(gloss, {-std::sqrt(1 - cosine * cosine), 0, cosine}, count, shift, samples);
  const std::size_t padded = (samples.size() + ConeLobe::kLanes - 1) / ConeLobe::kLanes * ConeLobe::kLanes;
  ConeLobe lobe;
  for (std::vector<float>* values : {&lobe.x, &lobe.z, &lobe.weight}) values->resize(padded);
  double whole = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    lobe.x[i] = static_cast<float>(samples[i].direction.x());
    lobe.z[i] = static_cast<float>(samples[i].direction.z());
    lobe.weight[i] = static_cast<float>(samples[i].weight);
    whole += samples[i].weight;
  }
  lobe.whole = static_cast<float>(whole);
  return lobe;
}

double cone_share(const ConeLobe& lobe, const ConeArguments& arguments) {
  const double tilt = arguments.view_angle - arguments.apart;  // angle of the bent normal from the normal,
                                                               // toward the mirrored view
  const auto bent_x = static_cast<float>(std::sin(tilt));
  const auto bent_z = static_cast<float>(std::cos(tilt));
  const auto least = static_cast<float>(std::cos(arguments.half_angle));
  std::array<float, ConeLobe::kLanes> sums{};  // separate sums, so that compilers can vectorize the loop
  for (std::size_t i = 0; i < lobe.weight.size(); i += ConeLobe::kLanes) {
    for (std::size_t k = 0; k < ConeLobe::kLanes; ++k) {
      const float cosine = lobe.x[i + k] * bent_x + lobe.z[i + k] * bent_z;
      sums[k] += cosine >= least ? lobe.weight[i + k] : 0.0F;
    }
  }
  double sum = 0;
  for (const float lane : sums) sum += double{lane};
  return lobe.whole > 0 ? std::min(1.0, sum / double{lobe.whole}) : 0;
}

}  // namespace heightlight
