#include <gtest/gtest.h>

#include "integrate/back_wall_record.h"
#include "integrate/stage.h"
#include "isophote/cache/volume_cache.h"
#include "isophote/integrate/record_picture.h"
#include "support/media.h"
#include "support/volume_records.h"

// Records in media, where a plane cuts them.
namespace isophote::test {
namespace {

constexpr int size = 128;  // of pictures

RecordCache with_volumes(const Job& job) {
  RecordCache cache = empty_cache(job);
  cache.set_volumes(std::make_shared<VolumeCaches>(cache.bounds()));
  return cache;
}

/// Of the semi-axes 0.5, 0.3 and 0.2, along none of the coordinates.
VolumeRecord ellipsoid() {
  VolumeRecord record = volume_record({0.1f, -0.05f, 0.08f}, 0.5f);
  const Frame frame(normalize(Vec3{0.4f, -0.5f, 0.7f}));
  record.footprint.shape =
      Sym3::outer(frame.u, 1 / 0.25f) + Sym3::outer(frame.v, 1 / 0.09f) + Sym3::outer(frame.n, 1 / 0.04f);
  return record;
}

/// The root of the record's form, 1 on its surface, where the ray through (x, y) meets the plane.
double form(const Job& job, const Plane& plane, const VolumeRecord& record, double x, double y) {
  const Ray ray = job.camera.ray(static_cast<float>(x), static_cast<float>(y), size, size);
  const Vec3d o(ray.origin), d(ray.direction), n(plane.normal);
  const Vec3d q = o + d * (dot(Vec3d(plane.point) - o, n) / dot(d, n)) - Vec3d(record.position);
  return std::sqrt(quadratic_form(Sym3d(record.footprint.shape), q));
}

bool is_coloured(const Rgb& c) { return c.r != c.g || c.g != c.b; }

int coloured(const RgbImage& picture) {
  return static_cast<int>(std::count_if(picture.pixels.begin(), picture.pixels.end(), is_coloured));
}

TEST(VolumeSlice, DrawsTheEllipseInWhichThePlaneCutsARecord) {
  const Stage stage(scenes::cloud_under_a_white_sky(scenes::medium(Rgb(1), Rgb(0), {{-1, -1, -1}, {1, 1, 1}})));
  const Job job = stage.job(method("jarosz2008a"), size, size, 1);
  RecordCache cache = with_volumes(job);
  const VolumeRecord record = ellipsoid();
  cache.volumes()->media.insert(record);
  cache.volumes()->surfaces.insert(volume_record({0, 0, 0}, 9));  // its rim is out of sight
  const Plane plane{{0, 0, 0.05f}, normalize(Vec3{0.3f, -0.2f, 1})};
  const RgbImage picture = record_picture(job, cache, RecordColour::radius, plane).picture;

  int rims = 0, filled = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double u = x + 0.5, v = y + 0.5, t = form(job, plane, record, u, v);
      const double slope = std::hypot(form(job, plane, record, u + 0.5, v) - form(job, plane, record, u - 0.5, v),
                                      form(job, plane, record, u, v + 0.5) - form(job, plane, record, u, v - 0.5));
      const double inside = (1 - t) / slope;  // pixels
      const Rgb& c = picture.at(x, y);
      if (inside < -1) {
        EXPECT_TRUE(is_black(c)) << "outside, at " << x << "," << y;
      } else if (inside > 0.7 && inside < 1.1) {
        EXPECT_TRUE(is_coloured(c)) << "on the rim, at " << x << "," << y;
        ++rims;
      } else if (inside > 3) {
        EXPECT_TRUE(!is_coloured(c) && c.r > 0) << "inside, at " << x << "," << y;
        ++filled;
      }
    }
  EXPECT_GT(rims, 20);
  EXPECT_GT(filled, 200);
}

TEST(VolumeSlice, TellsMultipleScatteringFromLightOfSurfaces) {
  const Stage stage(scenes::cloud_under_a_white_sky(scenes::medium(Rgb(1), Rgb(0), {{-1, -1, -1}, {1, 1, 1}})));
  const Job job = stage.job(method("jarosz2008a"), size, size, 1);
  const auto marked = [&](VolumePart part) {
    RecordCache cache = with_volumes(job);
    cache.volumes()->of(part).insert(ellipsoid());
    return coloured(record_picture(job, cache, RecordColour::radius).picture);
  };
  EXPECT_GT(marked(VolumePart::surfaces), 20);
  EXPECT_GT(marked(VolumePart::media), 1.3 * marked(VolumePart::surfaces));
}

TEST(VolumeSlice, LiesHalfwayThroughTheRecordsAndFacesTheCamera) {
  const Stage stage(scenes::cloud_under_a_white_sky(scenes::medium(Rgb(1), Rgb(0), {{-1, -1, -1}, {1, 1, 1}})));
  const Job job = stage.job(method("jarosz2008a"), size, size, 1);
  RecordCache cache = with_volumes(job);
  EXPECT_FALSE(record_picture(job, cache, RecordColour::radius).slice);
  for (const float z : {-0.5f, 0.3f, 0.7f}) cache.volumes()->media.insert(volume_record({z, 0, z}, 0.1f));
  const auto plane = record_picture(job, cache, RecordColour::radius).slice;
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->point.z, 0.1f, 1e-6);
  EXPECT_NEAR(std::abs(plane->normal.z), 1, 1e-6);
}

TEST(VolumeSlice, IsHiddenBySurfacesAndEndsWithTheMedia) {
  Scene scene = scenes::cornell_box();
  scene.media.push_back(scenes::medium(Rgb(0.3f), Rgb(0), {{-1, 0, -3}, {1, 2, 1}}));
  const Stage stage(std::move(scene));
  const Job job = stage.job(method("jarosz2008a"), size, size, 1);
  RecordCache cache = empty_cache(job);
  cache.insert(back_wall_record());
  const RgbImage surfaces = record_picture(job, cache, RecordColour::error).picture;
  cache.set_volumes(std::make_shared<VolumeCaches>(cache.bounds()));
  cache.volumes()->media.insert(volume_record({0, 1, 0.8f}, 0.2f));
  const auto cut_at = [&](float z) {
    return record_picture(job, cache, RecordColour::error, Plane{{0, 0, z}, {0, 0, 1}}).picture.pixels;
  };
  EXPECT_EQ(cut_at(-2), surfaces.pixels);    // behind the back wall
  EXPECT_EQ(cut_at(1.5f), surfaces.pixels);  // before the media
  EXPECT_EQ(cut_at(5), surfaces.pixels);     // behind the camera
  EXPECT_NE(cut_at(0.8f), surfaces.pixels);
}

}  // namespace
}  // namespace isophote::test
