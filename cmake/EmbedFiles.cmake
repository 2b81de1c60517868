# cmake -D FOLDER=scenes -D ENDINGS=obj,mtl -D HEADER=path/of/header.h -D FUNCTION=Name -D OUTPUT=x.cpp -P EmbedFiles.cmake:
# the texts of a folder's files as string literals, sorted by name. The header declares
# `std::span<const EmbeddedFile> Name()`.

string(REPLACE "," ";" endings "${ENDINGS}")
set(files "")
foreach(ending IN LISTS endings)
  file(GLOB some "${FOLDER}/*.${ending}")
  list(APPEND files ${some})
endforeach()
list(SORT files)
set(entries "")
foreach(file IN LISTS files)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  string(APPEND entries "    {\"${name}\", R\"penumbra(${text})penumbra\"},\n")
endforeach()
get_filename_component(folder "${FOLDER}" NAME)
file(WRITE "${OUTPUT}.new" "// Made from the folder ${folder}/ by cmake/EmbedFiles.cmake.

#include \"${HEADER}\"

namespace penumbra {

std::span<const EmbeddedFile> ${FUNCTION}() {
  static constexpr EmbeddedFile kFiles[] = {
${entries}  };
  return kFiles;
}

}  // namespace penumbra
")
file(COPY_FILE "${OUTPUT}.new" "${OUTPUT}" ONLY_IF_DIFFERENT)
file(REMOVE "${OUTPUT}.new")
