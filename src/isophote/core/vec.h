#pragma once

#include <algorithm>
#include <cmath>

namespace isophote {

/// A vector in three dimensions: a point, a direction or a normal. `Vec3` is stored, `Vec3d` is computed with.
template <class T>
struct Vec3T {
  T x = 0, y = 0, z = 0;

  constexpr Vec3T() = default;
  constexpr Vec3T(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
  template <class S>
  explicit constexpr Vec3T(const Vec3T<S>& v)
      : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)) {}

  constexpr T operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }

  constexpr Vec3T operator-() const { return {-x, -y, -z}; }
  constexpr Vec3T operator+(const Vec3T& o) const { return {x + o.x, y + o.y, z + o.z}; }
  constexpr Vec3T operator-(const Vec3T& o) const { return {x - o.x, y - o.y, z - o.z}; }
  constexpr Vec3T operator*(T s) const { return {x * s, y * s, z * s}; }
  constexpr Vec3T operator/(T s) const { return {x / s, y / s, z / s}; }
  constexpr Vec3T& operator+=(const Vec3T& o) { return *this = *this + o; }
  constexpr Vec3T& operator-=(const Vec3T& o) { return *this = *this - o; }
  constexpr Vec3T& operator*=(T s) { return *this = *this * s; }
  constexpr bool operator==(const Vec3T&) const = default;
  friend constexpr Vec3T operator*(T s, const Vec3T& v) { return v * s; }
};

using Vec3 = Vec3T<float>;
using Vec3d = Vec3T<double>;

template <class T>
constexpr T dot(const Vec3T<T>& a, const Vec3T<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3T<T> cross(const Vec3T<T>& a, const Vec3T<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
constexpr T length_squared(const Vec3T<T>& a) {
  return dot(a, a);
}
template <class T>
T length(const Vec3T<T>& a) {
  return std::sqrt(dot(a, a));
}
/// The unit vector along `a`; `a` must not be zero.
template <class T>
Vec3T<T> normalize(const Vec3T<T>& a) {
  return a / length(a);
}
template <class T>
constexpr Vec3T<T> min(const Vec3T<T>& a, const Vec3T<T>& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
template <class T>
constexpr Vec3T<T> max(const Vec3T<T>& a, const Vec3T<T>& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
template <class T>
constexpr T max_component(const Vec3T<T>& a) {
  return std::max(a.x, std::max(a.y, a.z));
}
template <class T>
bool is_finite(const Vec3T<T>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// A pair of numbers: a texture coordinate or a point of the unit square.
struct Vec2 {
  float x = 0, y = 0;
  constexpr Vec2 operator+(const Vec2& o) const { return {x + o.x, y + o.y}; }
  constexpr Vec2 operator-(const Vec2& o) const { return {x - o.x, y - o.y}; }
  constexpr Vec2 operator*(float s) const { return {x * s, y * s}; }
  constexpr bool operator==(const Vec2&) const = default;
};

/// An axis-aligned box; the default one is empty.
struct Box {
  Vec3 lower{1e30f, 1e30f, 1e30f}, upper{-1e30f, -1e30f, -1e30f};

  void extend(const Vec3& p) { lower = min(lower, p), upper = max(upper, p); }
  bool empty() const { return lower.x > upper.x; }
  Vec3 center() const { return (lower + upper) * 0.5f; }
  Vec3 size() const { return upper - lower; }
  float diagonal() const { return length(size()); }
};

}  // namespace isophote
