# cmake -D FOLDER=scenes -D OUTPUT=x.cpp -P EmbedScenes.cmake: the texts of the built-in scenes as string literals.

file(GLOB files "${FOLDER}/*.obj" "${FOLDER}/*.mtl")
list(SORT files)
set(entries "")
foreach(file IN LISTS files)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  string(APPEND entries "    {\"${name}\", R\"penumbra(${text})penumbra\"},\n")
endforeach()
file(WRITE "${OUTPUT}.new" "// Made from the folder scenes/ by cmake/EmbedScenes.cmake.

#include \"solver/scene/embedded_scenes.h\"

namespace penumbra {

std::span<const EmbeddedFile> EmbeddedSceneFiles() {
  static constexpr EmbeddedFile kFiles[] = {
${entries}  };
  return kFiles;
}

}  // namespace penumbra
")
file(COPY_FILE "${OUTPUT}.new" "${OUTPUT}" ONLY_IF_DIFFERENT)
file(REMOVE "${OUTPUT}.new")
