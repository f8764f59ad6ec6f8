#pragma once

#include <span>

#include "isophote/derivatives/volume_radiance.h"
#include "support/media_room.h"

namespace isophote::test {

/// The direction in which light goes on that places in media scatter.
inline Vec3d outgoing() { return normalize(Vec3d{0.5, -0.6, 0.3}); }

/// A phase function as a weight of directions, in turned axes.
struct PhaseWeight {
  HenyeyGreenstein phase;
  Vec3d wo = turned_axes().to_local(outgoing());

  int count() const { return 1; }
  void operator()(const Vec3d& w, std::span<double> values) const { values[0] = phase(-dot(w, wo)); }
  void operator()(const Vec3d& w, std::span<double> values, std::span<Vec3d> slopes) const {
    const double cosine = -dot(w, wo);
    values[0] = phase(cosine);
    slopes[0] = (w * dot(w, wo) - wo) * (values[0] * phase.log_slope(cosine));
  }
};

struct KnownRadiance {
  double value;
  Vec3d gradient;
  Sym3d hessian;
};

/// A place in a medium of the room, with what is scattered there towards `outgoing`, of surfaces and of the shaft: of
/// an independent program, by differences of fine quadratures. The gradient is known to about 1e-3, the Hessian to
/// 1e-2.
struct KnownPlace {
  const char* name;
  AnalyticMedium::Kind kind;
  double g;
  Vec3d at;
  KnownRadiance surfaces, media;

  MediaRoom room() const { return {kind, g}; }
  const KnownRadiance& known(VolumePart part) const { return part == VolumePart::surfaces ? surfaces : media; }
};

inline constexpr auto homogeneous = AnalyticMedium::Kind::homogeneous, fog = AnalyticMedium::Kind::fog,
                      blob = AnalyticMedium::Kind::blob;
/// P1 is beside the shaft, P2 in it, P4 behind the plate.
inline constexpr KnownPlace known_places[] = {
    {"P4 homogeneous",
     homogeneous,
     0,
     {0.05, -0.2, 0.75},
     {0.302227, {-0.190227, 0.0385547, 0.0143253}, {-0.944487, 0.0251567, -0.00152, 0.507593, 0.0141167, 0.697063}},
     {0.00782138,
      {-0.00991467, 0.026521, 0.0152287},
      {-0.0160667, -0.0490533, -0.0368067, 0.0919633, 0.08702, 0.06309}}},
    {"P4 homogeneous, g 0.6",
     homogeneous,
     0.6,
     {0.05, -0.2, 0.75},
     {0.30145, {-0.034198, 0.103243, -0.0208933}, {-0.429057, 0.0323067, -0.15726, 0.259757, 0.116597, 0.494907}},
     {0.00522343, {-0.00834867, 0.0134773, 0.012013}, {0.0186333, -0.03029, -0.0475, 0.0347833, 0.03604, 0.06449}}},
    {"P1 homogeneous",
     homogeneous,
     0,
     {-0.4, 0.35, 1.3},
     {0.453819, {0.0400297, 0.137957, 0.188807}, {0.177573, -0.06219, 0.0721967, 0.213963, 0.0349133, 0.20136}},
     {0.00577045,
      {0.0104953, -0.00327233, -0.0104243},
      {0.0230767, -0.0119233, -0.02669, -0.0181667, 0.00932667, 0.0279667}}},
    {"P1 homogeneous, g 0.6",
     homogeneous,
     0.6,
     {-0.4, 0.35, 1.3},
     {0.471378, {-0.0432153, 0.281044, 0.174297}, {0.19702, 0.00818333, -0.0219733, 0.358427, 0.0902867, 0.0767067}},
     {0.0015679,
      {0.00274933, -0.002166, -0.004124},
      {0.00602333, -0.00666333, -0.0102433, -0.00247, 0.00763333, 0.01341}}},
    {"P1 fog",
     fog,
     0,
     {-0.4, 0.35, 1.3},
     {0.62333, {0.0917387, 0.129103, 0.304923}, {0.08969, -0.0844733, 0.1131, 0.0998733, 0.0347, -0.01487}},
     {0.00595967,
      {0.007517, -0.00274867, -0.0115977},
      {0.0106667, -0.00863, -0.0224733, -0.0184467, 0.00936333, 0.03533}}},
    {"P1 blob, g 0.6",
     blob,
     0.6,
     {-0.4, 0.35, 1.3},
     {0.614445, {-0.125712, 0.313266, 0.347903}, {-0.447333, 0.169927, 0.45616, 0.231273, -0.0920533, -0.00863333}},
     {0.00162407,
      {0.00265767, -0.00224733, -0.00430333},
      {0.00647, -0.00722333, -0.01175, -0.00236, 0.00823, 0.01639}}},
    {"P2 homogeneous",
     homogeneous,
     0,
     {-0.4, 0.4, 0.5},
     {0.366727, {0.0615283, 0.102717, 0.0285647}, {0.0794033, -0.0101267, -0.164, 0.119903, 0.11931, 0.315793}},
     {0.0324265, {0.00976067, -0.032684, 0.010285}, {-0.0789933, -0.0711133, 0.09662, -0.585097, -0.04566, -0.143807}}},
    {"P2 fog, g 0.6",
     fog,
     0.6,
     {-0.4, 0.4, 0.5},
     {0.373405, {0.0272877, 0.194087, 0.222629}, {0.14422, -0.06135, -0.165543, 0.29575, 0.208613, 0.50264}},
     {0.0185019,
      {-0.00632833, -0.0510937, -0.006552},
      {-0.0437167, -0.0532233, 0.0461167, -0.38817, 0.00506, -0.0824133}}},
};
enum Known { P4, P4_lobe, P1, P1_lobe, P1_fog, P1_blob_lobe, P2, P2_fog_lobe };

inline constexpr VolumePart both_parts[] = {VolumePart::surfaces, VolumePart::media};

/// A gradient in turned axes, in the room's.
inline Vec3d in_room(const Gradient<Rgbd>& g) { return turned_axes().to_world(Vec3d{g.x.r, g.y.r, g.z.r}); }
inline Sym3d in_room(const Sym3d& h) {
  const Framed axes = turned_axes();
  const Vec3d x = axes.to_local({1, 0, 0}), y = axes.to_local({0, 1, 0}), z = axes.to_local({0, 0, 1});
  return {dot(x, h * x), dot(x, h * y), dot(x, h * z), dot(y, h * y), dot(y, h * z), dot(z, h * z)};
}
inline double relative_error(const Sym3d& estimate, const Sym3d& truth) {
  return norm(estimate + truth * -1) / norm(truth);
}
inline double relative_error(const Vec3d& estimate, const Vec3d& truth) {
  return length(estimate - truth) / length(truth);
}

}  // namespace isophote::test
