#include "io/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "model/geometry/types.h"

namespace retarget::io {
namespace {

// Many accessors may name the same data, so that a small file could ask for all memory. No real
// file comes near it: 100 joints with every channel for 10 minutes at 60 per second are 36 million.
constexpr size_t kMostNumbers = 50'000'000;

template <typename T>
double NumberAt(const unsigned char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

// One component. Fractions as the specification decodes them (glTF 2.0, 3.6.2.2 and 3.11).
double Component(const unsigned char* at, int type, bool normalised) {
  double value = 0, largest = 1;
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      value = NumberAt<std::int8_t>(at);
      largest = INT8_MAX;
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      value = NumberAt<std::uint8_t>(at);
      largest = UINT8_MAX;
      break;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      value = NumberAt<std::int16_t>(at);
      largest = INT16_MAX;
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      value = NumberAt<std::uint16_t>(at);
      largest = UINT16_MAX;
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      value = NumberAt<std::uint32_t>(at);
      break;
    default:
      value = NumberAt<float>(at);
  }
  return normalised ? std::max(value / largest, -1.0) : value;
}

size_t ComponentBytes(int type) {
  switch (type) {
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

}  // namespace

void GltfAccessors::Fail(int accessor, const std::string& what) const {
  throw InputError(fmt::format("{}: accessors[{}]: {}", name_, accessor, what));
}

GltfAccessors::Items GltfAccessors::Locate(int accessor, int view_index, size_t offset,
                                           size_t count, size_t item_bytes, bool packed) const {
  if (view_index < 0 || view_index >= static_cast<int>(model_.bufferViews.size())) {
    Fail(accessor, "it has no buffer view");
  }
  const tinygltf::BufferView& view = model_.bufferViews[view_index];
  if (!view.extensions.empty()) {
    throw InputError(fmt::format("{}: its data are compressed ({}): export it uncompressed", name_,
                                 view.extensions.begin()->first));
  }
  const std::vector<unsigned char>& data = model_.buffers[view.buffer].data;
  const size_t stride = packed || view.byteStride == 0 ? item_bytes : view.byteStride;
  // In this order no sum or product can overflow.
  const bool inside = view.byteOffset <= data.size() &&
                      view.byteLength <= data.size() - view.byteOffset &&
                      offset <= view.byteLength && count > 0 && stride >= item_bytes &&
                      item_bytes <= view.byteLength - offset &&
                      count - 1 <= (view.byteLength - offset - item_bytes) / stride;
  if (!inside) Fail(accessor, "it reaches beyond its data");
  return {data.data() + view.byteOffset + offset, stride};
}

std::vector<double> GltfAccessors::Read(int index, int type) {
  const tinygltf::Accessor& accessor = model_.accessors[index];
  const size_t components = static_cast<size_t>(tinygltf::GetNumComponentsInType(type));
  const size_t bytes = ComponentBytes(accessor.componentType);
  if (accessor.type != type || bytes == 0) {
    Fail(index, fmt::format("expected items of {} numbers", components));
  }
  if (accessor.normalized && (IsFloat(index) || bytes == 4)) {
    Fail(index, "only 8 and 16 bit integers can be normalised");
  }
  if (accessor.count == 0) Fail(index, "it is empty");
  numbers_read_ += accessor.count * components;
  if (numbers_read_ > kMostNumbers) Fail(index, "the file holds too many numbers");

  std::vector<double> values;
  if (accessor.bufferView >= 0) {
    const Items items = Locate(index, accessor.bufferView, accessor.byteOffset, accessor.count,
                               components * bytes, false);
    values.reserve(accessor.count * components);
    for (size_t i = 0; i < accessor.count; ++i) {
      const unsigned char* item = items.data + i * items.stride;
      for (size_t c = 0; c < components; ++c) {
        values.push_back(Component(item + c * bytes, accessor.componentType, accessor.normalized));
      }
    }
  } else if (accessor.sparse.isSparse) {
    // Zeros, of which some are replaced: no more than a file of that many replacements warrants.
    constexpr size_t kZerosPerReplacement = 1000;
    if (accessor.sparse.count <= 0 ||
        accessor.count / kZerosPerReplacement > static_cast<size_t>(accessor.sparse.count)) {
      Fail(index, "it has no data");
    }
    Locate(index, accessor.sparse.values.bufferView,
           static_cast<size_t>(std::max(0, accessor.sparse.values.byteOffset)),
           static_cast<size_t>(accessor.sparse.count), components * bytes, true);
    values.assign(accessor.count * components, 0.0);
  } else {
    Fail(index, "it has no data");
  }
  if (accessor.sparse.isSparse) ReplaceSparse(index, components, &values);
  for (const double v : values) {
    if (!std::isfinite(v)) Fail(index, "a number is not finite");
  }
  return values;
}

void GltfAccessors::ReplaceSparse(int index, size_t components, std::vector<double>* values) const {
  const tinygltf::Accessor& accessor = model_.accessors[index];
  const auto& sparse = accessor.sparse;
  const size_t bytes = ComponentBytes(accessor.componentType);
  const size_t index_bytes = ComponentBytes(sparse.indices.componentType);
  if (sparse.count <= 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 ||
      index_bytes == 0 || sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) {
    Fail(index, "its sparse part is damaged");
  }
  const size_t count = static_cast<size_t>(sparse.count);
  const Items where =
      Locate(index, sparse.indices.bufferView, static_cast<size_t>(sparse.indices.byteOffset),
             count, index_bytes, true);
  const Items what =
      Locate(index, sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset), count,
             components * bytes, true);
  for (size_t i = 0; i < count; ++i) {
    const double at = Component(where.data + i * where.stride, sparse.indices.componentType, false);
    if (!(at >= 0 && at < static_cast<double>(accessor.count))) {
      Fail(index, "a sparse index is out of range");
    }
    for (size_t c = 0; c < components; ++c) {
      (*values)[static_cast<size_t>(at) * components + c] = Component(
          what.data + i * what.stride + c * bytes, accessor.componentType, accessor.normalized);
    }
  }
}

}  // namespace retarget::io
