#include "io/gltf/extensions.h"

#include <algorithm>
#include <array>

namespace retarget::io {
namespace {

// Of the registry of Khronos and of VRM 1.0. Whatever refers to nodes, or stands in the document's
// own `extensions`, is not here.
constexpr std::array<std::string_view, 26> kCopied = {
    // Materials: their only indices are those of textures, in members called "...Texture".
    "KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion", "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_materials_iridescence", "KHR_materials_pbrSpecularGlossiness", "KHR_materials_sheen",
    "KHR_materials_specular", "KHR_materials_transmission", "KHR_materials_unlit",
    "KHR_materials_volume", "KHR_materials_volume_scatter", "VRMC_materials_mtoon",
    "VRMC_materials_hdr_emissiveMultiplier",
    // Textures: an image in `source`.
    "KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds",
    // Meshes and nodes.
    "KHR_texture_transform", "KHR_draco_mesh_compression", "KHR_mesh_quantization",
    "EXT_mesh_gpu_instancing", "KHR_node_visibility", "KHR_node_hoverability"};

constexpr std::array<std::string_view, 6> kDispensable = {"KHR_lights_punctual",
                                                          "EXT_lights_image_based",
                                                          "KHR_animation_pointer",
                                                          "KHR_materials_variants",
                                                          "MSFT_lod",
                                                          "KHR_xmp_json_ld"};

template <size_t kSize>
bool Holds(const std::array<std::string_view, kSize>& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

bool IsCopiedExtension(std::string_view name) { return Holds(kCopied, name); }

bool HasNoObject(std::string_view name) { return name == "KHR_mesh_quantization"; }

bool CanBeLeftOut(std::string_view name) {
  return Holds(kDispensable, name) || name == "VRM" || name.starts_with("VRMC_");
}

}  // namespace retarget::io
