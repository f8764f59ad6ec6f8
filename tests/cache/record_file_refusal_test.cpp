#include <functional>
#include <limits>
#include <vector>

#include "record_file_fixture.h"

namespace isophote::test {
namespace {

/// With the media of another.
RecordFile joined(RecordFile file, const RecordFile& media) {
  file.volumes = media.volumes;
  return file;
}

TEST_F(RecordFileTest, EveryFlippedByteIsRefused) {
  write_records(path_, joined(with_radiance(1), with_media(0)));
  const std::string whole = bytes();
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const int flip : {0x01, 0x80}) {
      std::string harmed = whole;
      harmed[i] = static_cast<char>(harmed[i] ^ flip);
      put(harmed);
      EXPECT_NE(refusal(), "") << "byte " << i;
    }
}

TEST_F(RecordFileTest, EveryTruncationAndAnExtensionIsRefused) {
  write_records(path_, joined(with_radiance(2), with_media(0)));
  const std::string whole = bytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    put(whole.substr(0, size));
    EXPECT_NE(refusal(), "") << size << " bytes";
  }
  put(whole + '\0');
  EXPECT_NE(refusal(), "");
}

TEST_F(RecordFileTest, WrongLengthsWithARightChecksumAreRefused) {
  const RecordFile file = sample(3);
  write_records(path_, file);
  const std::string whole = bytes();
  const std::size_t count_at = settings_at + file.settings.size() + survey_bytes;
  for (const std::uint64_t count :
       {0ull, 2ull, 4ull, 1ull << 32, 0xffffffffffffffffull, 0xffffffffffffffffull / record_bytes + 4}) {
    std::string crafted = whole;
    put_integer(crafted, count_at, count, 8);
    put_signed(crafted);
    EXPECT_NE(refusal().find("malformed"), std::string::npos) << count;
  }
  for (const std::uint64_t length : {std::uint64_t{0}, file.settings.size() - 1, file.settings.size() + 1,
                                     whole.size() - 48, whole.size(), std::uint64_t{0xffffffff}}) {
    std::string crafted = whole;
    put_integer(crafted, settings_at - 4, length, 4);
    put_signed(crafted);
    EXPECT_NE(refusal().find("malformed"), std::string::npos) << length;
  }
}

TEST_F(RecordFileTest, ASurveyOfNonsenseIsRefused) {
  const RecordFile file = sample(1);
  write_records(path_, file);
  const std::string whole = bytes();
  const std::size_t survey_at = settings_at + file.settings.size();
  for (const unsigned known : {2u, 0x80u, 0xffu}) {
    std::string crafted = whole;
    put_integer(crafted, survey_at, known, 1);
    put_signed(crafted);
    EXPECT_NE(refusal().find("survey"), std::string::npos) << known;
  }
  std::string negative = whole;
  negative[survey_at + 4] |= '\x80';
  put_signed(negative);
  EXPECT_NE(refusal().find("survey"), std::string::npos);
  for (const float threshold : {0.0f, -0.1f, 1.5f, std::numeric_limits<float>::quiet_NaN()}) {
    std::string crafted = whole;
    put_integer(crafted, survey_at + 13, std::bit_cast<std::uint32_t>(threshold), 4);
    put_signed(crafted);
    EXPECT_EQ(refusal(), "its threshold is malformed") << threshold;
  }
}

// Whoever signs a file of nonsense still does not get it into a lookup.

TEST_F(RecordFileTest, UnusableRecordsWithARightChecksumAreRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::function<void(Record&)>> harms = {
      [&](Record& r) { r.position.y = nan; },
      [&](Record& r) {
        r.normal = {0, 0, 2};
      },
      [&](Record& r) {
        r.normal = {0, 0, 0};
      },
      [&](Record& r) { r.footprint.shape.xx = -1; },
      [&](Record& r) { r.footprint.shape.zz = infinity; },
      [&](Record& r) { r.footprint.shape.xy = nan; },
      [&](Record& r) { r.footprint.shape.xy = r.footprint.shape.xx; },  // a positive diagonal, but a saddle
      [&](Record& r) { r.footprint.shape.yz = 2 * r.footprint.shape.zz; },
      [&](Record& r) { r.footprint.shape.zz *= 0.99f; },  // reaches beyond the radius
      [&](Record& r) { r.footprint.radius *= 0.99f; },
      [&](Record& r) { r.footprint.normal_scale = nan; },
      [&](Record& r) { r.footprint.normal_scale = -1; },
      [&](Record& r) { r.footprint.radius = 0; },
      [&](Record& r) { r.footprint.radius = infinity; },
      [&](Record& r) { r.footprint.unscaled = nan; },
      [&](Record& r) { r.footprint.smallest = r.footprint.radius * 2; },
      [&](Record& r) { r.footprint.largest = r.footprint.radius / 2; },
      [&](Record& r) { r.footprint.largest = nan; },
      [&](Record& r) { r.footprint.falloff = static_cast<Falloff>(4); },
      [&](Record& r) { r.footprint.order = 3; },
      [&](Record& r) { r.footprint.logarithmic = true; },  // which surfaces are not
      [&](Record& r) { r.curvature_scale = -1; },
      [&](Record& r) { r.jet.hessian.xy = nan; },
      [&](Record& r) { r.curvature_scale = 1, r.jet.hessian.xx = 3e38f; },
      [&](Record& r) { r.gradient_scale = nan; },
      [&](Record& r) { r.gradient_scale = 1.5f; },
      [&](Record& r) { r.jet.value.g = infinity; },
      [&](Record& r) { r.jet.value.g = nan; },
      [&](Record& r) { r.jet.value.b = -1e-3f; },
      [&](Record& r) { r.jet.value.r = 3e38f; },
      [&](Record& r) { r.jet.translational.z.b = nan; },
      [&](Record& r) { r.jet.translational.y.g = -2e30f / r.footprint.radius; },
      [&](Record& r) { r.jet.rotational.x.r = nan; },
      [&](Record& r) { r.jet.rotational.z.b = 3e38f; },
      [&](Record& r) { r.jet.distances.harmonic_mean = nan; },
      [&](Record& r) { r.jet.distances.obstacles.nearest[5] = 0x8001; },  // negative
      [&](Record& r) { r.jet.distances.obstacles.nearest[15] = 0x7fc0; },
  };
  for (std::size_t i = 0; i < harms.size(); ++i) {
    RecordFile file = sample(3);
    harms[i](file.records[1]);
    write_records(path_, file);
    EXPECT_EQ(refusal(), "record 1 is malformed") << "harm " << i;
  }
}

TEST_F(RecordFileTest, UnusableRadianceWithARightChecksumIsRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::function<void(RadianceRecord&)>> harms = {
      [&](RadianceRecord& r) { r.position.y = nan; },
      [&](RadianceRecord& r) { r.footprint.radius = 0; },
      [&](RadianceRecord& r) { r.gradient_scale = 2; },
      [&](RadianceRecord& r) { r.jet.value[4].g = nan; },
      [&](RadianceRecord& r) { r.jet.value[8].b = -3e38f; },
      [&](RadianceRecord& r) { r.jet.translational.x[0].r = infinity; },
      [&](RadianceRecord& r) { r.jet.translational.y[7].b = nan; },
      [&](RadianceRecord& r) { r.jet.distances.harmonic_mean = nan; },
      [&](RadianceRecord& r) { r.jet.distances.obstacles.nearest[5] = 0x8001; },
  };
  for (std::size_t i = 0; i < harms.size(); ++i) {
    RecordFile file = with_radiance(1);
    harms[i](file.radiance[1]);
    write_records(path_, file);
    EXPECT_EQ(refusal(), "record 1 of radiance is malformed") << "harm " << i;
  }
  const RecordFile file = with_radiance(1);
  write_records(path_, file);
  const std::string whole = bytes();
  const std::size_t head_at = settings_at + file.settings.size() + survey_bytes + 8 + record_bytes,
                    bands_at = head_at + radiance_head_bytes + radiance_record_bytes - 2;
  const auto crafted = [&](std::size_t at, std::uint64_t value, int size) {
    std::string bytes = whole;
    put_integer(bytes, at, value, size);
    put_signed(bytes);
    return refusal();
  };
  EXPECT_EQ(crafted(head_at, 2, 1), "its basis is malformed");
  for (const std::uint64_t count : {0ull, 1ull, 3ull, 1ull << 40, 0xffffffffffffffffull})
    EXPECT_NE(crafted(head_at + 1, count, 8).find("malformed"), std::string::npos) << count;
  for (const unsigned bands : {0u, 2u, 17u, 255u})
    EXPECT_NE(crafted(bands_at, bands, 1).find("malformed"), std::string::npos) << bands;
  for (const unsigned gradient : {1u, 2u})
    EXPECT_NE(crafted(bands_at + 1, gradient, 1).find("malformed"), std::string::npos) << gradient;
}

TEST_F(RecordFileTest, UnusableMediaWithARightChecksumAreRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::function<void(VolumeRecord&)>> harms = {
      [&](VolumeRecord& r) { r.position.y = nan; },
      [&](VolumeRecord& r) {
        r.normal = {0, 0, 1};
      },
      [&](VolumeRecord& r) { r.footprint.radius = 0; },
      [&](VolumeRecord& r) { r.footprint.shape.xy = nan; },
      [&](VolumeRecord& r) { r.footprint.order = 2; },
      [&](VolumeRecord& r) { r.gradient_scale = 2; },
      [&](VolumeRecord& r) { r.jet.value[0].g = -1; },
      [&](VolumeRecord& r) { r.jet.value[4].g = nan; },
      [&](VolumeRecord& r) { r.jet.value[8].b = -3e38f; },
      [&](VolumeRecord& r) { r.jet.translational.x[0].r = infinity; },
      [&](VolumeRecord& r) { r.jet.translational.y[7].b = nan; },
      [&](VolumeRecord& r) { r.jet.translational.z[8].b = 2e30f / r.footprint.radius; },
      [&](VolumeRecord& r) { r.jet.hessian.yz = infinity; },
      [&](VolumeRecord& r) { r.jet.value_sum = -1; },
      [&](VolumeRecord& r) { r.jet.gradient_sum = nan; },
      [&](VolumeRecord& r) { r.jet.obstacles.nearest[23] = 0x8001; },  // negative
      [&](VolumeRecord& r) { r.jet.standard_error = infinity; },
      [&](VolumeRecord& r) { r.jet.distances.harmonic_mean = nan; },
  };
  for (std::size_t i = 0; i < harms.size(); ++i) {
    RecordFile file = with_media(1);
    harms[i](file.volumes[0][1]);
    write_records(path_, file);
    EXPECT_EQ(refusal(), "record 1 of media is malformed") << "harm " << i;
  }
  const RecordFile file = with_media(0);
  write_records(path_, file);
  const std::string whole = bytes();
  const std::size_t count_at = settings_at + file.settings.size() + survey_bytes + 8 + radiance_head_bytes,
                    bands_at = count_at + 8 + volume_record_bytes - 2, logarithmic_at = count_at + 8 + 70;
  const auto crafted = [&](std::size_t at, std::uint64_t value, int size) {
    std::string bytes = whole;
    put_integer(bytes, at, value, size);
    put_signed(bytes);
    return refusal();
  };
  EXPECT_EQ(crafted(logarithmic_at, 1, 1), "");
  EXPECT_EQ(crafted(logarithmic_at, 2, 1), "record 0 of media is malformed");
  for (const std::uint64_t count : {0ull, 1ull, 3ull, 1ull << 40, 0xffffffffffffffffull})
    EXPECT_NE(crafted(count_at, count, 8).find("malformed"), std::string::npos) << count;
  for (const unsigned bands : {0u, 2u, 11u, 255u})
    EXPECT_NE(crafted(bands_at, bands, 1).find("malformed"), std::string::npos) << bands;
  for (const unsigned gradient : {1u, 2u})
    EXPECT_NE(crafted(bands_at + 1, gradient, 1).find("malformed"), std::string::npos) << gradient;
}

TEST_F(RecordFileTest, WhatIsNoRecordFile) {
  EXPECT_EQ(refusal(), "cannot be opened");
  for (const std::string& content :
       {std::string(), std::string("ISOPHRE"), std::string("\x89PNG\r\n\x1a\n and more")}) {
    put(content);
    EXPECT_EQ(refusal(), "is not a record file");
  }
  fs::remove(path_);
  fs::create_directory(path_);
  EXPECT_EQ(refusal(), "is not a regular file");
  EXPECT_THROW(write_records(path_, sample(1)), UserError);
}

// Neither what never ends is read to its end, nor is a count believed before there are records to it.

TEST_F(RecordFileTest, HugeFilesAreRefusedAtOnce) {
  path_ = "/dev/zero";
  EXPECT_EQ(refusal(), "is not a regular file");
  SetUp();
  write_records(path_, sample(1));
  const std::string head = bytes().substr(0, settings_at);
  for (const std::size_t start : {std::size_t{0}, settings_at}) {  // the rest is a hole, which takes no disk
    put(head.substr(0, start));
    fs::resize_file(path_, 1ull << 40);
    EXPECT_NE(refusal(), "") << start;
  }
  std::string counting = head;
  put_integer(counting, settings_at - 4, 0, 4);
  const std::uint64_t count = (1ull << 40) / record_bytes;
  counting.resize(settings_at + survey_bytes + 8);
  put_integer(counting, settings_at + survey_bytes - 4, std::bit_cast<std::uint32_t>(1.0f), 4);
  put_integer(counting, settings_at + survey_bytes, count, 8);
  put(counting);
  fs::resize_file(path_, empty_bytes + record_bytes * count);
  EXPECT_EQ(refusal(), "record 0 is malformed");
}

// A footprint may be flatter than its radius along any axis.

}  // namespace
}  // namespace isophote::test
