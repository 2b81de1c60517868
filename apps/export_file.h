// apps/export_file.h
//
// Meshes and scenes in the formats of other programs, chosen by the ending of the file's name.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

// What is wrong with the ending; nothing if it is one that we write.
std::optional<std::string> ExportFormatError(const std::string& path);
// The files that are written beside the one of a scene: an .obj has a library.
std::vector<std::string> FilesBeside(const std::string& path);
// Whether the format holds the mesh, and not the scene alone.
bool ExportsMesh(const std::string& path);
// Whether the format holds colours for a screen, or a camera.
bool ExportsColours(const std::string& path);
bool ExportsCamera(const std::string& path);
// The endings of the formats that do, with their dots: ".ply and .glb".
std::string EndingsWithColours();
std::string EndingsWithCamera();
// A line for each format.
std::string ExportFormats();

// Both throw InputError if a file cannot be written. REQUIRES: no ExportFormatError(path). `exposure` [m^2/W]
// makes the colours; metered from the mesh if not given.
void ExportMesh(const std::string& path, const Scene& scene, const IrradianceMesh& mesh,
                std::optional<double> exposure);
void ExportScene(const std::string& path, const Scene& scene, const Camera& camera);

}  // namespace penumbra
