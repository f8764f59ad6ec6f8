#pragma once

#include <algorithm>
#include <cmath>

namespace isophote {

/// A quantity in three linear channels (Rec. 709 primaries): radiance, irradiance, albedo, throughput.
template <class T>
struct RgbT {
  T r = 0, g = 0, b = 0;

  constexpr RgbT() = default;
  constexpr RgbT(T r_, T g_, T b_) : r(r_), g(g_), b(b_) {}
  explicit constexpr RgbT(T grey) : r(grey), g(grey), b(grey) {}
  template <class S>
  explicit constexpr RgbT(const RgbT<S>& c) : r(static_cast<T>(c.r)), g(static_cast<T>(c.g)), b(static_cast<T>(c.b)) {}

  constexpr T operator[](int i) const { return i == 0 ? r : i == 1 ? g : b; }
  constexpr T& operator[](int i) { return i == 0 ? r : i == 1 ? g : b; }

  constexpr RgbT operator-() const { return {-r, -g, -b}; }
  constexpr RgbT operator+(const RgbT& o) const { return {r + o.r, g + o.g, b + o.b}; }
  constexpr RgbT operator-(const RgbT& o) const { return {r - o.r, g - o.g, b - o.b}; }
  constexpr RgbT operator*(const RgbT& o) const { return {r * o.r, g * o.g, b * o.b}; }
  constexpr RgbT operator*(T s) const { return {r * s, g * s, b * s}; }
  constexpr RgbT operator/(T s) const { return {r / s, g / s, b / s}; }
  constexpr RgbT& operator+=(const RgbT& o) { return *this = *this + o; }
  constexpr RgbT& operator-=(const RgbT& o) { return *this = *this - o; }
  constexpr RgbT& operator*=(const RgbT& o) { return *this = *this * o; }
  constexpr RgbT& operator*=(T s) { return *this = *this * s; }
  constexpr bool operator==(const RgbT&) const = default;
  friend constexpr RgbT operator*(T s, const RgbT& c) { return c * s; }
};

using Rgb = RgbT<float>;
using Rgbd = RgbT<double>;

template <class T>
constexpr T luminance(const RgbT<T>& c) {
  return T(0.2126) * c.r + T(0.7152) * c.g + T(0.0722) * c.b;
}
template <class T>
constexpr T max_component(const RgbT<T>& c) {
  return std::max(c.r, std::max(c.g, c.b));
}
template <class T>
constexpr T mean(const RgbT<T>& c) {
  return (c.r + c.g + c.b) / T(3);
}
template <class T>
constexpr RgbT<T> max(const RgbT<T>& a, const RgbT<T>& b) {
  return {std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b)};
}
template <class T>
constexpr bool is_black(const RgbT<T>& c) {
  return c.r == 0 && c.g == 0 && c.b == 0;
}
template <class T>
bool is_finite(const RgbT<T>& c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}
inline Rgb exp(const Rgb& c) { return {std::exp(c.r), std::exp(c.g), std::exp(c.b)}; }

}  // namespace isophote
