// apps/export_file.h
//
// Writes meshes and scenes in formats of other programs. The ending of the file's name determines the format.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

// A description of the fault in the path's ending; nothing if Penumbra writes this format.
std::optional<std::string> ExportFormatError(const std::string& path);
// The files that are written in addition to a scene's file: the material library of an .obj file.
std::vector<std::string> FilesBeside(const std::string& path);
// True if the format stores the mesh, not only the scene.
bool ExportsMesh(const std::string& path);
// True if the format stores colours for a screen, or a camera.
bool ExportsColours(const std::string& path);
bool ExportsCamera(const std::string& path);
// The endings of the formats that do, with their dots: ".ply and .glb".
std::string EndingsWithColours();
std::string EndingsWithCamera();
// A description of all formats, one line each.
std::string ExportFormats();

// Write the mesh, or the scene, to a file. Throw InputError if the file cannot be written. `exposure` [m^2/W]
// converts radiosity to colours; without a value, the exposure is metered from the mesh. REQUIRES:
// ExportFormatError(path) returns nothing.
void ExportMesh(const std::string& path, const Scene& scene, const IrradianceMesh& mesh,
                std::optional<double> exposure);
void ExportScene(const std::string& path, const Scene& scene, const Camera& camera);

}  // namespace penumbra
