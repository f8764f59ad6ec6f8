#include "isophote/integrate/pilot.h"

#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "support/scenes.h"

namespace isophote::test {
namespace {

Survey survey_of(const Stage& stage, const Method& m, RayCounts& counts) {
  const Job job = stage.job(m, 32, 32, 1);
  RecordCache cache = empty_cache(job);
  return survey(job, cache, random_places(job, counts), counts);
}

// In a furnace irradiance is known, nothing bends and nothing varies.
TEST(Survey, MeasuresAFurnace) {
  const Stage stage(scenes::room(scenes::emissive(Rgb(0.5f), Rgb(1))));
  RayCounts counts;
  const Survey seen = survey_of(stage, method("swept"), counts);
  EXPECT_NEAR(seen.pilot.irradiance / M_PI, 1, 0.01);
  EXPECT_EQ(seen.jets.size(), surveyed_places);
}

TEST(Survey, IsOnlyForMethodsThatAsk) {
  for (const char* name : {"ward1992", "bounded", "uniform", "path"}) EXPECT_FALSE(wants_survey(method(name))) << name;
  for (const char* name : {"swept", "jarosz2012", "cached"}) EXPECT_TRUE(wants_survey(method(name))) << name;
  Method rays_alone = method("ward1992");
  rays_alone.adaptive = true;
  EXPECT_TRUE(wants_survey(rays_alone));
}

// The rate is per length: in the box a thousand times smaller it is about a thousand times larger.
TEST(Survey, IsPerLength) {
  RayCounts counts;
  const Stage large("cornell-box.glb"), small("cornell-box-over-1000.glb");
  const float a = survey_of(large, method("swept"), counts).pilot.error_rate;
  const float b = survey_of(small, method("swept"), counts).pilot.error_rate;
  EXPECT_GT(a, 0);
  EXPECT_NEAR(b / a, 1000, 250);
}

// With rays chosen by the survey the mean standard error of its own gathers is what was wanted.
TEST(Survey, RaysThatAdaptReachTheNoiseWanted) {
  const Stage stage("cornell-box.glb");
  Method m = method("cached");
  m.adaptive = true;
  for (const double error : {0.02, 0.05}) {
    m.settings.a = threshold(*m.metric, error);
    RayCounts counts;
    const Survey seen = survey_of(stage, m, counts);
    double mean = 0;
    for (const Jet<Rgb>& jet : seen.jets)
      mean += jet.standard_error / luminance(jet.value) / static_cast<double>(seen.jets.size());
    EXPECT_NEAR(mean / m.noise(), 1, 0.2) << error;
  }
}

}  // namespace
}  // namespace isophote::test
