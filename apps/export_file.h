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
// Pictures are formats of irradiance maps only.
std::optional<std::string> ExportFormatError(const std::string& path);
// True if the format can be that of an irradiance map; IsMapOnly() is true if it can be nothing else.
bool ExportsMap(const std::string& path);
bool IsMapOnly(const std::string& path);
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
// The endings of irradiance maps.
std::string EndingsOfMaps();
// A description of all formats, one line each.
std::string ExportFormats();

// Writes the mesh to a file. Throws InputError if the file cannot be written. REQUIRES: the ending of the
// path is that of a known format, so that ExportFormatError(path) returns nullopt.
void ExportMesh(const std::string& path, const MeshExport& from);
// Writes an irradiance map of size x size pixels. Throws InputError like ExportMesh(), or if the map has no
// room for all patches. REQUIRES: ExportsMap(path).
void ExportMap(const std::string& path, const MeshExport& from, int size);
// Writes the scene without its light, and the camera if the format holds one. Throws InputError like
// ExportMesh().
void ExportScene(const std::string& path, const Scene& scene, const Camera& camera);

}  // namespace penumbra
