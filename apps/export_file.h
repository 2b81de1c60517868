// apps/export_file.h
//
// Writes meshes and scenes in formats of other programs. The ending of a file's name determines the format.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "display/mesh_writer.h"

namespace penumbra {

// Describes what is wrong with the path's ending; nullopt if Penumbra can write a format with this ending.
std::optional<std::string> ExportFormatError(const std::string& path);
// The paths of the files that are written in addition to the scene file `path`, such as the material library
// of an .obj file.
std::vector<std::string> FilesBeside(const std::string& path);
// True if the format of the file stores the mesh, not only the scene.
bool ExportsMesh(const std::string& path);
// ExportsColours() is true if the format of the file stores colours for a screen; ExportsCamera() is true if
// it stores a camera.
bool ExportsColours(const std::string& path);
bool ExportsCamera(const std::string& path);
// Lists of the file endings of all formats that store colours, and of those that store a camera. Example:
// ".ply and .glb".
std::string EndingsWithColours();
std::string EndingsWithCamera();
// A description of all formats, one line each.
std::string ExportFormats();

// ExportMesh() writes the mesh to a file, and ExportScene() the scene. ExportMesh() and ExportScene() throw
// InputError if the file cannot be written. REQUIRES: ExportFormatError(path) returns nullopt.
void ExportMesh(const std::string& path, const MeshExport& from);
void ExportScene(const std::string& path, const Scene& scene, const Camera& camera);

}  // namespace penumbra
