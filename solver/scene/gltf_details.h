// solver/scene/gltf_details.h
//
// Details of the JSON part of a glTF 2.0 file that the library Assimp 5.2 does not report.

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

struct GltfDetails {
  // Maps the index of a material to the factor on its emission: `emissiveStrength` of the glTF extension
  // KHR_materials_emissive_strength.
  std::map<int, double> emissive_strength;
  std::vector<int> metallic;  // the indices of the materials that the file declares to be metallic
  // The glTF extensions that concern the geometry and that the file declares as required.
  std::vector<std::string> required;
};

// Finds the details in the bytes of a .gltf or .glb file. The returned GltfDetails are empty if the bytes are
// damaged or of another glTF version; the reader of the whole file then reports the error.
GltfDetails FindGltfDetails(std::string_view bytes);

}  // namespace penumbra
