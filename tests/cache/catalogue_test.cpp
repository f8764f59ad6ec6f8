#include "isophote/cache/catalogue.h"

#include <gtest/gtest.h>

#include <set>

#include "isophote/core/error.h"

namespace isophote {
namespace {

std::string refusal(const Method& method) {
  try {
    check_combination(method);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}
template <class F>
std::string message(const F& f) {
  try {
    f();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}
bool mentions(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST(Catalogue, EveryMethodStandsAndIsFoundByItsName) {
  std::set<std::string> names;
  for (const Method& method : methods()) {
    EXPECT_EQ(refusal(method), "") << method.name;
    EXPECT_EQ(find_method(method.name).summary, method.summary);
    EXPECT_EQ(method.estimator == nullptr, method.metric == nullptr);
    EXPECT_TRUE(names.insert(method.name).second);
  }
  for (const char* name :
       {"path", "ward1988", "ward1992", "bounded", "jarosz2012", "schwarzhaupt2012", "swept", "uniform", "cached"})
    EXPECT_TRUE(names.count(name));
  for (const Estimator& e : estimators()) EXPECT_EQ(&find_estimator(e.name), &e);
  for (const Metric& m : metrics()) EXPECT_EQ(&find_metric(m.name), &m);
  EXPECT_FALSE(find_method("path").caches());
}

TEST(Catalogue, UnknownNamesListTheKnown) {
  const std::string method = message([] { find_method("ward1989"); });
  EXPECT_TRUE(mentions(method, "method 'ward1989'"));
  for (const Method& m : methods()) EXPECT_TRUE(mentions(method, m.name)) << method;
  const std::string estimator = message([] { find_estimator(""); });
  for (const Estimator& e : estimators()) EXPECT_TRUE(mentions(estimator, e.name)) << estimator;
  const std::string metric = message([] { find_metric("Split-Sphere"); });
  for (const Metric& m : metrics()) EXPECT_TRUE(mentions(metric, m.name)) << metric;
}

TEST(Catalogue, EveryPairWithoutBoundsIsAllowedWhoseNeedsAreMet) {
  for (const Estimator& e : estimators())
    for (const Metric& m : metrics()) {
      Method method = find_method("ward1992");
      method.estimator = &e, method.metric = &m;
      if (m.needs <= e.order)
        EXPECT_EQ(refusal(method), "");
      else
        EXPECT_TRUE(mentions(refusal(method), m.name) && mentions(refusal(method), e.name));
    }
}

TEST(Catalogue, RefusalsNameBothSides) {
  Method no_gradient = find_method("bounded");
  no_gradient.estimator = &find_estimator("irradiance");
  EXPECT_TRUE(mentions(refusal(no_gradient), "'bounded-split-sphere'") &&
              mentions(refusal(no_gradient), "'irradiance'"));
  no_gradient.settings.bounds.gradient = false;
  EXPECT_EQ(refusal(no_gradient), "");

  const RadiusBounds each[] = {{.min_pixels = 1}, {.max_pixels = 1}, {.min_view = 1},    {.max_view = 1},
                               {.min_length = 1}, {.max_length = 1}, {.gradient = true}, {.neighbours = 1}};
  for (const char* name : {"split-sphere", "uniform"})
    for (const RadiusBounds& bounds : each) {
      Method unheeded = find_method("ward1992");
      unheeded.metric = &find_metric(name);
      unheeded.settings.bounds = bounds;
      EXPECT_TRUE(mentions(refusal(unheeded), "'" + std::string(name) + "'"));
      EXPECT_TRUE(mentions(refusal(unheeded), "'ward-heckbert'"));
    }
  Method by_gradient = find_method("swept"), elliptical = find_method("bounded");
  by_gradient.settings.bounds.gradient = true;
  elliptical.settings.aspect = 2;
  EXPECT_TRUE(mentions(refusal(by_gradient), "'total-error'") && mentions(refusal(by_gradient), "gradient"));
  EXPECT_TRUE(mentions(refusal(elliptical), "'bounded-split-sphere'") && mentions(refusal(elliptical), "disks"));
}

TEST(Catalogue, MakesAndSettlesRecordsAsItsPartsSay) {
  HemisphereGather gather{{1, 2, 3}, Frame(Vec3{0, 0.6f, 0.8f}), {4, 12}, std::vector<GatherSample>(48)};
  for (std::size_t i = 0; i < 48; ++i) {
    const int j = static_cast<int>(i) / 12, k = static_cast<int>(i) % 12;
    gather.samples[i].direction = gather.frame.to_world(gather.strata.direction(j, k, {0.5f, 0.5f}));
    gather.samples[i].normal = -gather.samples[i].direction;
    gather.samples[i].distance = 1 + 0.1f * static_cast<float>(i);
    gather.samples[i].radiance = {1, 0.5f, static_cast<float>(i)};
  }
  const View view{.pixel = 0.001f, .scene_scale = 10};
  for (const Method& method : methods()) {
    if (!method.caches()) continue;
    std::vector<Record> records{method.make_record(gather, view)};
    EXPECT_EQ(records[0].position, gather.position);
    EXPECT_EQ(records[0].normal, gather.frame.n);
    EXPECT_EQ(records[0].footprint.order, std::min(method.order, method.estimator->order));
    EXPECT_EQ(method.leak_test, method.name == "cached");
    EXPECT_EQ(records[0].jet.distances.obstacles == Obstacles{}, !method.leak_test);
    EXPECT_EQ(records[0].jet.translational == Gradient<Rgb>{}, method.estimator->order == 0);
    const float radius = records[0].footprint.radius;
    const std::uint32_t fresh = 0;
    NeighbourIndex neighbours({gather.position, gather.position});
    method.settle({records, neighbours}, {&fresh, 1});
    EXPECT_EQ(records[0].footprint.radius, radius);
    EXPECT_GT(radius, 0);
  }
  // the bound on pixels is what sets these two apart here
  EXPECT_FLOAT_EQ(find_method("bounded").make_record(gather, view).footprint.radius, 0.02f);
  EXPECT_GT(find_method("ward1992").make_record(gather, view).footprint.radius, 0.1f);
}

}  // namespace
}  // namespace isophote
