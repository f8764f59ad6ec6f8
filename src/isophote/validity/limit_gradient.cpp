#include "isophote/validity/limit_gradient.h"

#include <algorithm>

namespace isophote {

void limit_gradient(Record& record, float natural_radius) {
  const auto& g = record.jet.translational;
  const float radius = record.footprint.radius;
  const float change = length(Vec3{luminance(g.x), luminance(g.y), luminance(g.z)}) * radius;
  const float value = luminance(record.jet.value);
  const float bounded = change > value ? value / change : 1.0f;
  record.gradient_scale = std::min(bounded, natural_radius / radius);
  record.gradient_scale = std::min(1.0f, record.gradient_scale);
}

}  // namespace isophote
