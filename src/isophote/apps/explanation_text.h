#pragma once

#include <string>

#include "isophote/integrate/explain.h"
#include "isophote/integrate/job.h"

namespace isophote::app {

/// What an explanation is of.
struct ExplainedPixel {
  const Job& job;
  const RecordCache& cache;
  int x = 0, y = 0;
};

/// Why a record serves or not, for scripts and for people.
struct Words {
  const char *key, *sentence;
};
Words words_of(Standing standing);

/// For people: aligned and with units.
void print_explanation(const ExplainedPixel& pixel, const Explanation& explanation);
/// For scripts: lengths in metres, angles in degrees, irradiance in W/m2, radiance in W/m2/sr.
void print_explanation_json(const ExplainedPixel& pixel, const Explanation& explanation);

}  // namespace isophote::app
