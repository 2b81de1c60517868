// apps/export_file.h
//
// Writes meshes and scenes in the formats of other programs. The ending of the file name selects the format.

#pragma once

#include <optional>
#include <string>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The error message for an unknown ending; nullopt if the format is known.
std::optional<std::string> ExportFormatError(const std::string& path);
// The path of the material library of an .obj file; nullopt for other formats.
std::optional<std::string> LibraryBeside(const std::string& path);
// Whether the format contains the mesh, not only the scene. REQUIRES: a known format.
bool ExportsMesh(const std::string& path);

// Both functions throw InputError if a file cannot be written. `exposure` [m^2/W] is the factor from
// radiosity to colours; without it, it is metered from the mesh.
void ExportMesh(const std::string& path, const Scene& scene, const IrradianceMesh& mesh,
                std::optional<double> exposure);
void ExportScene(const std::string& path, const Scene& scene, const Camera& camera);

}  // namespace penumbra
