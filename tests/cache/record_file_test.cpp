#include "record_file_fixture.h"

namespace isophote::test {
namespace {

TEST_F(RecordFileTest, RoundTripKeepsEveryBit) {
  for (const int count : {0, 1, 50}) {
    const RecordFile file = sample(count);
    write_records(path_, file);
    const RecordFile back = read_records(path_);
    EXPECT_EQ(back.scene, file.scene);
    EXPECT_EQ(back.settings, file.settings);
    EXPECT_EQ(back.pilot, file.pilot);
    EXPECT_EQ(back.threshold, file.threshold);
    ASSERT_EQ(back.records.size(), file.records.size());
    for (std::size_t i = 0; i < file.records.size(); ++i) {
      const Record &a = file.records[i], &b = back.records[i];
      EXPECT_EQ(a.position, b.position);
      EXPECT_EQ(a.normal, b.normal);
      EXPECT_EQ(a.footprint.shape, b.footprint.shape);
      EXPECT_EQ(a.footprint.normal_scale, b.footprint.normal_scale);
      EXPECT_EQ(a.footprint.radius, b.footprint.radius);
      EXPECT_EQ(a.footprint.unscaled, b.footprint.unscaled);
      EXPECT_EQ(a.footprint.smallest, b.footprint.smallest);
      EXPECT_EQ(a.footprint.largest, b.footprint.largest);
      EXPECT_EQ(a.footprint.falloff, b.footprint.falloff);
      EXPECT_EQ(a.footprint.order, b.footprint.order);
      EXPECT_EQ(a.gradient_scale, b.gradient_scale);
      EXPECT_EQ(a.curvature_scale, b.curvature_scale);
      EXPECT_EQ(a.jet.hessian, b.jet.hessian);
      EXPECT_EQ(a.jet.value, b.jet.value);
      EXPECT_EQ(a.jet.standard_error, b.jet.standard_error);
      EXPECT_EQ(a.jet.rays, b.jet.rays);
      EXPECT_EQ(a.jet.translational, b.jet.translational);
      EXPECT_EQ(a.jet.rotational, b.jet.rotational);
      EXPECT_EQ(a.jet.distances.harmonic_mean, b.jet.distances.harmonic_mean);
      EXPECT_EQ(a.jet.distances.obstacles, b.jet.distances.obstacles);
    }
    const std::string first = bytes();
    EXPECT_EQ(first.size(), empty_bytes + file.settings.size() + record_bytes * static_cast<std::size_t>(count));
    write_records(path_, back);
    EXPECT_EQ(bytes(), first);
  }
}

TEST_F(RecordFileTest, RadianceIsKeptToo) {
  const RecordFile file = with_radiance(1);
  write_records(path_, file);
  const RecordFile back = read_records(path_);
  EXPECT_EQ(back.basis, file.basis);
  ASSERT_EQ(back.radiance.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const RadianceRecord &a = file.radiance[i], &b = back.radiance[i];
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.footprint.shape, b.footprint.shape);
    EXPECT_EQ(a.jet.value, b.jet.value);
    EXPECT_EQ(a.jet.translational.x, b.jet.translational.x);
    EXPECT_EQ(a.jet.translational.y, b.jet.translational.y);
    EXPECT_EQ(a.jet.rays, b.jet.rays);
    EXPECT_EQ(a.jet.distances.obstacles, b.jet.distances.obstacles);
  }
  const std::string first = bytes();
  EXPECT_EQ(first.size(), empty_bytes + file.settings.size() + record_bytes + 2 * radiance_record_bytes +
                              coefficient_bytes * (1 + 3 * 9));
  write_records(path_, back);
  EXPECT_EQ(bytes(), first);
}

TEST_F(RecordFileTest, MediaAreKeptToo) {
  const RecordFile file = with_media(1);
  write_records(path_, file);
  const RecordFile back = read_records(path_);
  for (std::size_t part = 0; part < 2; ++part) {
    ASSERT_EQ(back.volumes[part].size(), file.volumes[part].size());
    for (std::size_t i = 0; i < file.volumes[part].size(); ++i) {
      const VolumeRecord &a = file.volumes[part][i], &b = back.volumes[part][i];
      EXPECT_EQ(a.position, b.position);
      EXPECT_EQ(b.normal, Vec3{});
      EXPECT_EQ(a.footprint.shape, b.footprint.shape);
      EXPECT_EQ(a.footprint.falloff, b.footprint.falloff);
      EXPECT_EQ(a.footprint.logarithmic, b.footprint.logarithmic);
      EXPECT_EQ(a.media, b.media);
      EXPECT_EQ(a.jet.value, b.jet.value);
      EXPECT_EQ(a.jet.translational, b.jet.translational);
      EXPECT_EQ(a.jet.hessian, b.jet.hessian);
      EXPECT_EQ(a.jet.value_sum, b.jet.value_sum);
      EXPECT_EQ(a.jet.gradient_sum, b.jet.gradient_sum);
      EXPECT_EQ(a.jet.obstacles, b.jet.obstacles);
      EXPECT_EQ(a.jet.standard_error, b.jet.standard_error);
      EXPECT_EQ(a.jet.gradient_error, b.jet.gradient_error);
      EXPECT_EQ(a.jet.rays, b.jet.rays);
      EXPECT_EQ(a.jet.distances.harmonic_mean, b.jet.distances.harmonic_mean);
    }
  }
  const std::string first = bytes();
  EXPECT_EQ(first.size(), empty_bytes + file.settings.size() + record_bytes + 3 * volume_record_bytes +
                              coefficient_bytes * (1 + 4 * 9 + 4 * 4));
  write_records(path_, back);
  EXPECT_EQ(bytes(), first);
}

TEST_F(RecordFileTest, IsLittleEndianAndVersioned) {
  write_records(path_, sample(1));
  const std::string content = bytes();
  EXPECT_EQ(content.substr(0, 12), std::string("ISOPHREC\10\0\0\0", 12));
  EXPECT_EQ(static_cast<unsigned char>(content[12]), 0xef);  // the scene's lowest byte
  for (const unsigned other : {7u, 9u}) {
    std::string crafted = content;
    put_integer(crafted, 8, other, 4);
    put_signed(crafted);
    EXPECT_EQ(refusal(), "has version " + std::to_string(other) + ", this program reads 8");
  }
}

TEST_F(RecordFileTest, FlatFootprintsAreKept) {
  RecordFile file = sample(1);
  Footprint& f = file.records[0].footprint;
  const Vec3 axis = normalize(Vec3{1, 2, -2});
  for (const float height : {1.0f, 0.5f, 0.1f, 0.01f}) {
    const float base = 1 / (f.radius * f.radius), more = base / (height * height) - base;
    f.shape = {base + more * axis.x * axis.x, more * axis.x * axis.y, more * axis.x * axis.z,
               base + more * axis.y * axis.y, more * axis.y * axis.z, base + more * axis.z * axis.z};
    write_records(path_, file);
    EXPECT_EQ(refusal(), "") << height;
  }
}

TEST_F(RecordFileTest, MismatchesNameTheReason) {
  const RecordFile file = sample(1);
  const auto reason = [&](std::uint64_t scene, const std::string& settings) -> std::string {
    try {
      require_match("x.rec", file, scene, settings);
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(reason(file.scene, file.settings), "");
  EXPECT_EQ(reason(file.scene + 1, file.settings), "x.rec: its records were made for another scene");
  EXPECT_EQ(reason(file.scene, "method=bounded\na=0.3\nseed=8\n"),
            "x.rec: its records were made with other settings: a=0.2 there, a=0.3 here");
  EXPECT_EQ(reason(file.scene, "method=bounded\na=0.2\n"),
            "x.rec: its records were made with other settings: seed=7 there, nothing here");
  EXPECT_EQ(reason(file.scene, file.settings + "rays=800\n"),
            "x.rec: its records were made with other settings: nothing there, rays=800 here");
}

}  // namespace
}  // namespace isophote::test
