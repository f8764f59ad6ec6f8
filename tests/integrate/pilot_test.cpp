#include "isophote/integrate/pilot.h"

#include <gtest/gtest.h>

#include "integrate/stage.h"
#include "support/scenes.h"

namespace isophote::test {
namespace {

// In a furnace irradiance is known and nothing bends.
TEST(Pilot, MeasuresAFurnace) {
  const Stage stage(scenes::room(scenes::emissive(Rgb(0.5f), Rgb(1))));
  RayCounts counts;
  const Pilot pilot = run_pilot(stage.job(method("swept"), 32, 32, 1), counts);
  EXPECT_NEAR(pilot.irradiance / M_PI, 1, 0.01);
  EXPECT_GT(counts.gather, 256u * 190);
}

TEST(Pilot, IsOnlyForMetricsThatAsk) {
  const Stage stage("cornell-box.glb");
  for (const char* name : {"ward1992", "cached", "uniform", "path"}) {
    RayCounts counts;
    EXPECT_EQ(run_pilot(stage.job(method(name), 32, 32, 1), counts).error_rate, 0) << name;
    EXPECT_EQ(counts.total(), 0u) << name;
  }
}

// The rate is per length: in the box a thousand times smaller it is about a thousand times larger.
TEST(Pilot, IsPerLength) {
  RayCounts counts;
  const Stage large("cornell-box.glb"), small("cornell-box-over-1000.glb");
  const float a = run_pilot(large.job(method("swept"), 32, 32, 1), counts).error_rate;
  const float b = run_pilot(small.job(method("swept"), 32, 32, 1), counts).error_rate;
  EXPECT_GT(a, 0);
  EXPECT_NEAR(b / a, 1000, 250);
}

}  // namespace
}  // namespace isophote::test
