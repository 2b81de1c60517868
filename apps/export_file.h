// apps/export_file.h
//
// Meshes and scenes in the formats of other programs, chosen by the ending of the file's name.

#pragma once

#include <optional>
#include <string>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

// What is wrong with the ending; nothing if it is one that we write.
std::optional<std::string> ExportFormatError(const std::string& path);
// Where the materials of an .obj go; nothing for other formats.
std::optional<std::string> LibraryBeside(const std::string& path);
// Whether the format holds the mesh, and not the scene alone. REQUIRES: one that we write.
bool ExportsMesh(const std::string& path);

// Both throw InputError if a file cannot be written. `exposure` [m^2/W] makes the colours; metered from the
// mesh if not given.
void ExportMesh(const std::string& path, const Scene& scene, const IrradianceMesh& mesh,
                std::optional<double> exposure);
void ExportScene(const std::string& path, const Scene& scene, const Camera& camera);

}  // namespace penumbra
