#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <string>

namespace isophote {

/// Random access to the elements of an accessor (byte strides, sparse replacement, zeros where there is no buffer
/// view). The whole range is checked on construction, so that reading needs no check.
class AccessorReader {
 public:
  /// Throws UserError `accessors[I]: reason`.
  AccessorReader(const tinygltf::Model& model, int accessor);

  std::size_t count() const { return accessor_.count; }
  int type() const { return accessor_.type; }                     ///< TINYGLTF_TYPE_*
  int component_type() const { return accessor_.componentType; }  ///< TINYGLTF_COMPONENT_TYPE_*

  bool holds_indices() const;  ///< scalars of unsigned integers

  /// Component k of element i: floats as they are, unsigned integers mapped to [0, 1], signed ones to [-1, 1].
  float value(std::size_t i, std::size_t k) const;
  /// Element i, where `holds_indices`.
  std::uint32_t index(std::size_t i) const;

 private:
  const unsigned char* element(std::size_t i) const;
  [[noreturn]] void fail(const std::string& reason) const;
  const unsigned char* checked_range(int buffer_view, std::size_t offset, std::size_t count, std::size_t size,
                                     std::size_t stride) const;
  void open_sparse();

  const tinygltf::Model& model_;
  const tinygltf::Accessor& accessor_;
  int index_;
  const unsigned char* data_ = nullptr;  ///< null: zeros
  std::size_t stride_ = 0, element_size_ = 0;
  const unsigned char *sparse_indices_ = nullptr, *sparse_values_ = nullptr;
};

}  // namespace isophote
