#include <gtest/gtest.h>

#include "isophote/cache/catalogue.h"
#include "isophote/core/error.h"
#include "isophote/validity/limit_extrapolation.h"
#include "isophote/validity/volume_error.h"
#include "support/volume_records.h"

namespace isophote::test {
namespace {

std::string refusal(const VolumeMethod& method) {
  try {
    check_combination(method);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}
bool mentions(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

/// Of gradient 3 over a value of 1, of which the samples know no more than `gradient_sum` says.
template <int gradient_sum>
VolumeJet steep(const SphereGather&, VolumePart, int bands) {
  VolumeRecord r = volume_record({}, 1);
  set_slope(r, {Rgb(3.0f), {}, {}});
  r.jet.value.resize(harmonics_count(bands));
  r.jet.value_sum = 1, r.jet.gradient_sum = gradient_sum;
  r.jet.hessian = {4, 0, 0, -1, 0, 0.25f};
  return r.jet;
}

TEST(VolumeCatalogue, RowsAreFoundByTheirNames) {
  for (const VolumeEstimator& e : volume_estimators()) EXPECT_EQ(&find_volume_estimator(e.name), &e);
  for (const VolumeMetric& m : volume_metrics()) EXPECT_EQ(&find_volume_metric(m.name), &m);
  EXPECT_THROW(find_volume_estimator("triangulated"), UsageError);
  EXPECT_THROW(find_volume_metric("split-sphere"), UsageError);
  int methods_with_media = 0;
  for (const Method& m : methods()) {
    methods_with_media += m.volume.caches();
    EXPECT_EQ(m.volume.caches(), m.volume.estimator && m.volume.metric);
  }
  EXPECT_EQ(methods_with_media, 4);
  EXPECT_TRUE(find_method("jarosz2008a").volume.logarithmic);
  EXPECT_FALSE(find_method("marco2018").volume.logarithmic);
}

TEST(VolumeCatalogue, SurfacesAreCachedAsTheirPresetsDo) {
  for (const auto& [name, preset] : {std::pair{"jarosz2008a", "bounded"}, {"marco2018", "schwarzhaupt2012"}}) {
    const Method a = find_method(name), b = find_method(preset);
    EXPECT_EQ(a.estimator, b.estimator);
    EXPECT_EQ(a.metric, b.metric);
    EXPECT_EQ(a.order, b.order);
    EXPECT_EQ(a.settings.bounds, b.settings.bounds);
    EXPECT_EQ(a.settings.aspect, b.settings.aspect);
  }
}

TEST(VolumeCatalogue, PairsAreAllowedWhoseNeedsAreMet) {
  const VolumeEstimator known[] = {{.name = "value"},
                                   {.name = "gradient", .order = 1},
                                   {.name = "sums", .order = 1, .sums = true},
                                   {.name = "hessian", .order = 2},
                                   {.name = "all", .order = 2, .sums = true}};
  for (const VolumeMetric& m : volume_metrics())
    for (const VolumeEstimator& e : known) {
      const std::string why = refusal({InScattering::cache, &e, &m, {}});
      const bool lacks_sums = m.needs_sums && !e.sums, lacks_order = e.order < m.needs;
      EXPECT_EQ(why != "", lacks_sums || lacks_order) << m.name << ", " << e.name;
      if (why != "") {
        EXPECT_TRUE(mentions(why, m.name) && mentions(why, e.name));
        EXPECT_TRUE(mentions(why, lacks_sums ? "gradients of samples" : "Hessian"));
      }
    }
  // And whole methods are refused by their volumes, but only where those are cached.
  Method method = find_method("jarosz2008a");
  method.volume.estimator = &known[3];
  EXPECT_THROW(check_combination(method), UsageError);
  method.volume.from = InScattering::paths;
  EXPECT_NO_THROW(check_combination(method));
}

TEST(VolumeCatalogue, SettingsThatNobodyHeedsAreRefused) {
  const VolumeEstimator all{.name = "all", .order = 2, .sums = true}, value{.name = "value", .sums = true};
  const VolumeMetric &change = find_volume_metric("relative-change"), &error = find_volume_metric("volume-error"),
                     &uniform = find_volume_metric("uniform");
  const auto refused = [&](const VolumeEstimator& e, const VolumeMetric& m, const MetricSettings& s) {
    return refusal({InScattering::cache, &e, &m, s}) != "";
  };
  EXPECT_FALSE(refused(all, change, {.bounds = {.gradient = true}}));
  EXPECT_TRUE(refused(value, change, {.bounds = {.gradient = true}}));
  EXPECT_FALSE(refused(all, error, {.bounds = {.gradient = true}}));
  EXPECT_TRUE(refused(all, uniform, {.bounds = {.gradient = true}}));
  EXPECT_TRUE(refused(all, uniform, {.bounds = {.min_pixels = 1}}));
  EXPECT_FALSE(refused(all, error, {.bounds = {}, .aspect = 4}));
  EXPECT_TRUE(refused(all, change, {.bounds = {}, .aspect = 4}));
}

TEST(VolumeCatalogue, ThresholdsAimAtAnError) {
  EXPECT_FLOAT_EQ(threshold(find_volume_metric("volume-error"), 0.03), 0.03f);
  EXPECT_FLOAT_EQ(threshold(find_volume_metric("relative-change"), 0.04), 2.3f);
}

TEST(VolumeCatalogue, MakesAndSettlesRecordsAsItsPartsSay) {
  const View view{.pixel = 0.001f, .scene_scale = 10};
  SphereGather gather;
  gather.position = {1, 2, 3};
  VolumeEstimator estimator{.name = "steep", .order = 2, .sums = true, .estimate = steep<1>};
  Method method = find_method("jarosz2008a");
  method.volume.estimator = &estimator;
  method.volume.settings.a = 0.2f;
  const auto made = [&] {
    return method.make_volume_record(gather.position, estimator.estimate(gather, VolumePart::media, 2), 5, view);
  };
  VolumeRecord record = made();
  EXPECT_EQ(record.position, gather.position);
  EXPECT_EQ(record.normal, Vec3{});
  EXPECT_EQ(record.media, 5u);
  EXPECT_EQ(record.jet.value.size(), 4u);
  EXPECT_TRUE(record.footprint.logarithmic);
  EXPECT_EQ(record.footprint.order, 1);
  EXPECT_FLOAT_EQ(record.footprint.radius, 0.2f);
  method.volume.settings.bounds.gradient = true;
  EXPECT_FLOAT_EQ(made().footprint.radius, 0.2f / 3);

  method.volume = find_method("marco2018").volume;
  method.volume.estimator = &estimator;
  method.volume.settings.a = 0.02f;
  record = made();
  EXPECT_FALSE(record.footprint.logarithmic);
  const Footprint expected = volume_error(record.jet, view, 0.02f, method.volume.settings.bounds, 4);
  EXPECT_EQ(record.footprint.shape, expected.shape);
  record.footprint = Footprint::ball(1);
  NeighbourIndex neighbours({gather.position, gather.position});
  const std::uint32_t fresh = 0;
  method.settle({{&record, 1}, neighbours}, {&fresh, 1});
  EXPECT_FLOAT_EQ(record.gradient_scale, 1.0f / 3);
  method.settle(SettlingOf<VolumeRecord>{{}, neighbours}, {});
}

}  // namespace
}  // namespace isophote::test
