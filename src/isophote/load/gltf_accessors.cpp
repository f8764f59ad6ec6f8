#include "isophote/load/gltf_accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "isophote/core/error.h"

namespace isophote {
namespace {

template <class T>
T load(const unsigned char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

std::uint32_t load_index(const unsigned char* at, int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *at;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(at);
    default:
      return load<std::uint32_t>(at);
  }
}

float load_value(const unsigned char* at, int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return std::max(load<std::int8_t>(at) / 127.0f, -1.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *at / 255.0f;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return std::max(load<std::int16_t>(at) / 32767.0f, -1.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(at) / 65535.0f;
    default:
      return load<float>(at);
  }
}

std::size_t component_size(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

bool is_index_type(int component_type) {
  return component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

}  // namespace

AccessorReader::AccessorReader(const tinygltf::Model& model, int accessor)
    : model_(model), accessor_(model.accessors[static_cast<std::size_t>(accessor)]), index_(accessor) {
  const std::size_t component = component_size(accessor_.componentType);
  if (component == 0) fail(fmt::format("component type {} is not one of glTF 2.0", accessor_.componentType));
  if (accessor_.type == TINYGLTF_TYPE_MAT2 || accessor_.type == TINYGLTF_TYPE_MAT3 ||
      accessor_.type == TINYGLTF_TYPE_MAT4)
    fail("holds matrices, which no attribute of a mesh does");
  if (accessor_.count == 0 || accessor_.count > 0xffffffffull) fail("count must be between 1 and 2^32 - 1");
  element_size_ = component * static_cast<std::size_t>(
                                  tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor_.type)));
  stride_ = element_size_;
  if (accessor_.bufferView >= 0) {
    const std::size_t stride = model.bufferViews[static_cast<std::size_t>(accessor_.bufferView)].byteStride;
    if (stride != 0) stride_ = stride;
    if (stride_ < element_size_) fail("byteStride is less than an element");
    data_ = checked_range(accessor_.bufferView, accessor_.byteOffset, accessor_.count, element_size_, stride_);
  }
  if (accessor_.sparse.isSparse) open_sparse();
}

const unsigned char* AccessorReader::checked_range(int buffer_view, std::size_t offset, std::size_t count,
                                                   std::size_t size, std::size_t stride) const {
  const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(buffer_view)];
  // Counts stay below 2^32 and strides below 2^8: no product overflows.
  const std::size_t extent = (count - 1) * stride + size;
  if (offset > view.byteLength || extent > view.byteLength - offset)
    fail(fmt::format("reaches beyond the {} bytes of bufferViews[{}]", view.byteLength, buffer_view));
  return model_.buffers[static_cast<std::size_t>(view.buffer)].data.data() + view.byteOffset + offset;
}

void AccessorReader::open_sparse() {
  const auto& sparse = accessor_.sparse;
  const auto count = static_cast<std::size_t>(sparse.count);
  if (count == 0 || count > accessor_.count) fail("sparse.count must be between 1 and count");
  if (!is_index_type(sparse.indices.componentType)) fail("sparse.indices must be unsigned integers");
  const std::size_t index_size = component_size(sparse.indices.componentType);
  sparse_indices_ = checked_range(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
                                  index_size, index_size);
  sparse_values_ = checked_range(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
                                 element_size_, element_size_);
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t at = load_index(sparse_indices_ + i * index_size, sparse.indices.componentType);
    if (at >= accessor_.count || (i > 0 && at <= last)) fail("sparse.indices must increase and stay below count");
    last = at;
  }
}

const unsigned char* AccessorReader::element(std::size_t i) const {
  static constexpr std::array<unsigned char, 16> zeros{};
  if (sparse_indices_) {
    const int type = accessor_.sparse.indices.componentType;
    const std::size_t size = component_size(type);
    std::size_t low = 0, high = static_cast<std::size_t>(accessor_.sparse.count);
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      const std::uint32_t at = load_index(sparse_indices_ + middle * size, type);
      if (at == i) return sparse_values_ + middle * element_size_;
      if (at < i)
        low = middle + 1;
      else
        high = middle;
    }
  }
  return data_ ? data_ + i * stride_ : zeros.data();
}

bool AccessorReader::holds_indices() const {
  return accessor_.type == TINYGLTF_TYPE_SCALAR && is_index_type(accessor_.componentType);
}

float AccessorReader::value(std::size_t i, std::size_t k) const {
  return load_value(element(i) + k * component_size(accessor_.componentType), accessor_.componentType);
}

std::uint32_t AccessorReader::index(std::size_t i) const { return load_index(element(i), accessor_.componentType); }

void AccessorReader::fail(const std::string& reason) const {
  throw UserError(fmt::format("accessors[{}]: {}", index_, reason));
}

}  // namespace isophote
