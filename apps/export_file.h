// apps/export_file.h
//
// Writes meshes and scenes in formats of other programs. The ending of a file's name determines the format.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "display/atlas/light_atlas.h"
#include "display/mesh_writer.h"

namespace penumbra {

// The error message for a path whose ending is not that of a file format that Penumbra can write; nullopt if
// the ending is known. Picture formats are permitted for irradiance maps only.
std::optional<std::string> ExportFormatError(const std::string& path);
// ExportsMap() is true if the file format can store an irradiance map; IsMapOnly() is true if the format can
// store only irradiance maps.
bool ExportsMap(const std::string& path);
bool IsMapOnly(const std::string& path);
// The paths of the files that are written in addition to the scene file `path`, such as the material library
// of an .obj file.
std::vector<std::string> FilesBeside(const std::string& path);
// True if the format of the file stores the mesh, not only the scene.
bool ExportsMesh(const std::string& path);
// ExportsColours() is true if the format of the file stores colours for display on a screen; ExportsCamera()
// is true if the format stores a camera.
bool ExportsColours(const std::string& path);
bool ExportsCamera(const std::string& path);
// EndingsWithColours() lists the file endings of all formats that store colours, EndingsWithCamera() those of
// all formats that store a camera, for example ".ply and .glb".
std::string EndingsWithColours();
std::string EndingsWithCamera();
// Lists the file endings of all formats that store irradiance maps.
std::string EndingsOfMaps();
// A description of all export formats, with one line for each format.
std::string ExportFormats();

// Writes the mesh to a file. Throws InputError if the file cannot be written. REQUIRES: the ending of the
// path is that of a known format, so that ExportFormatError(path) returns nullopt.
void ExportMesh(const std::string& path, const MeshExport& from);
// Writes an irradiance map of size x size pixels. Throws InputError if the file cannot be written, or if the
// map cannot be made (MakeLightAtlas). REQUIRES: ExportsMap(path).
void ExportMap(const std::string& path, const MeshExport& from, int size, AtlasPlaces places);
// Writes the scene without a solution to a file, with the camera if the format stores cameras. Throws
// InputError if the file cannot be written.
void ExportScene(const std::string& path, const Scene& scene, const Camera& camera);

}  // namespace penumbra
