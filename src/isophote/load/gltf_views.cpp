#include "isophote/load/gltf_views.h"

#include <fmt/format.h>

#include <cmath>

#include "isophote/load/largest_radiance.h"
#include "isophote/load/messages.h"

namespace isophote {
namespace {

constexpr double degrees = pi / 180;

/// The unit vector along `v` in single precision. Throws UserError where there is none.
Vec3 direction(const Vec3d& v) {
  const double l = length(v);
  if (!(l > 0) || !std::isfinite(l)) throw UserError("its node's transform does not leave it a direction");
  return Vec3(v / l);
}

Vec3 position(const Vec3d& p) {
  const Vec3 rounded(p);
  if (!is_finite(rounded)) throw UserError("its node's transform moves it beyond all numbers");
  return rounded;
}

Camera perspective_camera(const tinygltf::Camera& source, const Affine& to_world) {
  if (source.type != "perspective") throw UserError("orthographic cameras are not supported, only perspective ones");
  const tinygltf::PerspectiveCamera& lens = source.perspective;
  if (!(lens.yfov > 0 && lens.yfov < pi)) throw UserError("perspective.yfov must lie between 0 and pi");
  if (lens.aspectRatio < 0) throw UserError("perspective.aspectRatio must be positive");
  Camera camera;
  camera.eye = position(to_world.origin);
  camera.forward = direction(-to_world.z);
  camera.right = direction(cross(Vec3d(camera.forward), to_world.y));
  camera.up = cross(camera.right, camera.forward);
  camera.fov_y = static_cast<float>(lens.yfov);
  camera.aspect = static_cast<float>(lens.aspectRatio);
  return camera;
}

void read_cones(const tinygltf::SpotLight& spot, PunctualLight& light) {
  constexpr double right_angle = 1.5707964;  // pi/2 as writers round it
  const double inner = spot.innerConeAngle, outer = spot.outerConeAngle;
  // The format wants the inner angle below the outer one; writers make them equal for an edge without falloff.
  if (!(inner >= 0 && inner <= outer && outer > 0 && outer <= right_angle))
    throw UserError("spot: 0 <= innerConeAngle <= outerConeAngle <= pi/2 and outerConeAngle > 0 must hold");
  light.inner_cone = static_cast<float>(inner);
  light.outer_cone = static_cast<float>(outer);
}

PunctualLight punctual_light(const tinygltf::Light& source, const Affine& to_world) {
  PunctualLight light;
  if (source.type == "point")
    light.kind = PunctualLight::Kind::point;
  else if (source.type == "spot")
    light.kind = PunctualLight::Kind::spot;
  else if (source.type == "directional")
    light.kind = PunctualLight::Kind::directional;
  else
    throw UserError("type '" + source.type + "' is not point, spot or directional");
  light.position = position(to_world.origin);
  if (light.kind != PunctualLight::Kind::point) light.direction = direction(-to_world.z);
  if (light.kind == PunctualLight::Kind::spot) read_cones(source.spot, light);
  Rgbd color{1.0};
  if (source.color.size() == 3) color = {source.color[0], source.color[1], source.color[2]};
  light.intensity = Rgb(color * source.intensity);
  if (!is_finite(light.intensity) || std::min({light.intensity.r, light.intensity.g, light.intensity.b}) < 0 ||
      max_component(light.intensity) > largest_radiance)
    throw UserError(fmt::format("color times intensity must be a number between 0 and {:g}", largest_radiance));
  if (source.range < 0) throw UserError("range must be positive");
  if (source.range > 0) light.range = static_cast<float>(source.range);
  return light;
}

}  // namespace

std::optional<Camera> read_camera(const tinygltf::Model& model, const PlacedNode& placed) {
  const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(placed.node)];
  if (node.camera < 0) return {};
  const auto i = static_cast<std::size_t>(node.camera);
  const tinygltf::Camera& source = model.cameras[i];
  Camera camera =
      with_place(place_name("cameras", i, source.name), [&] { return perspective_camera(source, placed.to_world); });
  camera.name = source.name.empty() ? node.name : source.name;
  return camera;
}

std::optional<PunctualLight> read_light(const tinygltf::Model& model, const PlacedNode& placed) {
  const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(placed.node)];
  // The parser leaves the light's index in the node's extensions.
  const auto extension = node.extensions.find("KHR_lights_punctual");
  if (extension == node.extensions.end()) return {};
  const auto i = static_cast<std::size_t>(extension->second.Get("light").GetNumberAsInt());
  const tinygltf::Light& source = model.lights[i];
  PunctualLight light =
      with_place(place_name("lights", i, source.name), [&] { return punctual_light(source, placed.to_world); });
  light.name = source.name.empty() ? node.name : source.name;
  return light;
}

Camera default_view(const Box& bounds) {
  constexpr double turn = 30 * degrees, elevation = 20 * degrees, fov_y = 40 * degrees;
  const double radius = bounds.diagonal() / 2.0;
  const Vec3d towards_eye{std::sin(turn) * std::cos(elevation), std::sin(elevation),
                          std::cos(turn) * std::cos(elevation)};
  // The sphere around the bounds touches the field of view from inside.
  const Vec3d eye = Vec3d(bounds.center()) + towards_eye * (radius / std::sin(fov_y / 2));
  Camera camera = Camera::look_at(Vec3(eye), bounds.center(), static_cast<float>(fov_y));
  camera.name = "default";
  return camera;
}

}  // namespace isophote
