// solver/scene/assimp_import.h
//
// Reads the files of modellers by the Open Asset Import Library (Assimp), which keeps numbers in single
// precision.

#pragma once

#include <string>

#include "solver/scene/foreign_scene.h"

namespace penumbra {

struct AssimpImport {
  std::string ending;         // of the format, without the dot: it tells Assimp what the bytes are
  bool has_materials = true;  // the format knows materials; otherwise what Assimp makes up is left out
  bool has_default = false;   // Assimp appends a material for faces that have none
  bool turned = false;        // Assimp turns this format from z up to y up: turn it back
  double applied_unit = 1;    // Assimp multiplies lengths by this unit, which the file gives: divide by it
};

// The scene in `bytes`, the content of the file `path`. Files that the file refers to are read from beside
// the path. Nodes and their instances become objects, called by the names of the nodes. A mirrored instance
// has its faces turned, so that its fronts stay outside.
//
// Assimp is not safe on damaged input: call this function by RunInChild(). Throws std::runtime_error, whose
// text is Assimp's, if the bytes cannot be read.
ForeignScene ImportByAssimp(const std::string& bytes, const std::string& path, const AssimpImport& how);

}  // namespace penumbra
