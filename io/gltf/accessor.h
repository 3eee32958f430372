// Numbers out of a glTF document's accessors. Inner part of io/gltf/clip.h.
#pragma once

#include <string>
#include <vector>

#include "io/gltf/load.h"

namespace retarget::io {

class GltfAccessors {
 public:
  // Both must outlive this object; `name` stands for the file in messages.
  GltfAccessors(const tinygltf::Model& model, const std::string& name)
      : model_(model), name_(name) {}

  size_t Count(int accessor) const { return model_.accessors[accessor].count; }

  // Whether an accessor holds whole numbers that stand for fractions of the largest one.
  bool IsNormalised(int accessor) const { return model_.accessors[accessor].normalized; }
  bool IsFloat(int accessor) const {
    return model_.accessors[accessor].componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
  }

  // All numbers, item after item, sparse replacements and normalisation done. [count * components]
  // Throws InputError where the accessor has another type, or reaches beyond its data, or a number
  // is not finite. `type` is TINYGLTF_TYPE_SCALAR, ...
  std::vector<double> Read(int accessor, int type);

 private:
  // Where an accessor's items lie: count, stride and place are known to be within the buffer.
  struct Items {
    const unsigned char* data = nullptr;  // null: zeros
    size_t stride = 0;
  };
  [[noreturn]] void Fail(int accessor, const std::string& what) const;
  Items Locate(int accessor, int view, size_t offset, size_t count, size_t item_bytes,
               bool packed) const;
  void ReplaceSparse(int accessor, size_t components, std::vector<double>* values) const;

  const tinygltf::Model& model_;
  const std::string& name_;
  size_t numbers_read_ = 0;
};

}  // namespace retarget::io
