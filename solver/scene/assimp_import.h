// solver/scene/assimp_import.h
//
// Reads files of 3D modelling programs by the Open Asset Import Library (Assimp), which keeps numbers in
// single precision.

#pragma once

#include <string>

#include "solver/scene/foreign_scene.h"

namespace penumbra {

struct AssimpImport {
  // The ending of the file's name without the dot, which tells Assimp the format of the bytes.
  std::string ending;
  // False if the format has no materials; materials that Assimp adds are then dropped.
  bool has_materials = true;
  bool has_default = false;  // true if Assimp adds a default material for faces without a material
  // True if Assimp rotates scenes from z up to y up; the reader rotates such scenes back.
  bool turned = false;
  // unit by which Assimp multiplies the lengths of the file; the reader divides by this unit
  double applied_unit = 1;
};

// Returns the scene in `bytes`, the content of the file `path`. Other files to which the file refers are read
// from the same folder. Each instance of a node of the file's scene graph becomes an object with the name of
// the node. In a mirrored instance, the order of the vertices of each face is reversed, so that fronts still
// look outwards.
//
// Assimp is not safe on damaged input: call ImportByAssimp() only in a child process (RunInChild). Throws
// std::runtime_error with Assimp's error message if the bytes cannot be read.
ForeignScene ImportByAssimp(const std::string& bytes, const std::string& path, const AssimpImport& how);

}  // namespace penumbra
