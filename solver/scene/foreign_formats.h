// solver/scene/foreign_formats.h
//
// The formats that are read through Assimp: how they are recognised, and in which frame they give lengths.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/assimp_import.h"
#include "solver/scene/foreign_scene.h"
#include "solver/scene/scene_frame.h"

namespace penumbra {

struct ForeignFormatEntry {
  std::string name;                  // "glTF"
  std::vector<std::string> endings;  // without the dot; the first tells Assimp the format
  std::string description;           // of FindForeignFormat() for its first bytes; empty if nothing shows it
  AssimpImport import;               // without the ending
  UpAxis up = UpAxis::kZ;            // as the format defines it, or as its programs use it
};

const std::vector<ForeignFormatEntry>& ForeignFormats();

// The entry for a file with these first bytes, whatever its name; null if nothing shows that it is one of
// them.
const ForeignFormatEntry* FormatByContent(std::string_view beginning);
// The entry for this ending, without the dot; null if there is none.
const ForeignFormatEntry* FormatByEnding(std::string_view ending);

// How a file gives its lengths, and whether the file or its format says so.
struct ForeignFrame {
  SceneFrame frame;
  bool unit_said = false, up_said = false;
};

// The frame that the content of a COLLADA file gives: the first `unit` and `up_axis`. By its standard, metres
// and y up if the file does not say.
ForeignFrame ColladaFrame(std::string_view bytes);

// The frame of a file of this format. `read` is the scene in the file.
ForeignFrame FrameOf(const ForeignFormatEntry& format, std::string_view bytes, const ForeignScene& read);

}  // namespace penumbra
