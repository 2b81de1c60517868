// solver/scene/gltf_details.h
//
// What the JSON part of a glTF 2.0 file says and Assimp 5.2 does not pass on.

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

struct GltfDetails {
  // By material, the factor of its emission: `emissiveStrength` of KHR_materials_emissive_strength.
  std::map<int, double> emissive_strength;
  std::vector<int> metallic;  // materials that say that they are metallic
  // The extensions without which, as the file says, it cannot be read, and which concern the geometry.
  std::vector<std::string> required;
};

// The details in the bytes of a .gltf or .glb file; none if the bytes are damaged or of another version, as
// the reader of the whole file will tell.
GltfDetails FindGltfDetails(std::string_view bytes);

}  // namespace penumbra
