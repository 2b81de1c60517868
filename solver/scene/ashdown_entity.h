// solver/scene/ashdown_entity.h
//
// The entity files of I. Ashdown, Radiosity: A Programmer's Perspective, 1994, section 3.10: vertices,
// surfaces, patches and elements of one object in its own frame.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "solver/geometry/polygon.h"
#include "solver/scene/scene.h"
#include "solver/scene/text_reader.h"

namespace penumbra {

// The lines of a world or entity file that hold data. Blank lines and comments, which begin with COMMENT, are
// skipped.
class AshdownLines {
 public:
  AshdownLines(std::string_view text, const std::string& path) : lines_(text), path_(path) {}

  // Advances to the next line with data; returns false at the end of the text.
  bool Next();
  // The text of the line that is not yet read.
  std::string_view Rest() const { return rest_; }
  // Reads a bracket, as many numbers as `values` has members, and another bracket. As in the book's parser,
  // any bracket is taken for any other. `what` names the numbers in the message of an error. Throws
  // InputError if a bracket or a finite number is missing.
  template <std::size_t count>
  std::array<double, count> Bracketed(std::string_view what) {
    std::array<double, count> values{};
    words_.clear();
    Bracket(what);
    for (double& value : values) value = Number(what);
    Bracket(what);
    return values;
  }
  // The words of the numbers that the last call of Bracketed() has read.
  const std::vector<std::string_view>& words() const { return words_; }
  // Reads an index. Throws InputError unless the number is a whole number from 0 to `count` - 1.
  std::size_t Index(std::string_view what, std::size_t count);
  // Converts a number to an index; throws the same exceptions as Index().
  std::size_t ToIndex(double value, std::string_view what, std::size_t count) const;

  // The number of the current line, from 1.
  int line() const { return line_; }
  // Returns an InputError that refers to the current line, for the caller to throw.
  InputError Error(std::string_view message) const { return ErrorAt(path_, line_, message); }

 private:
  void Bracket(std::string_view what);
  double Number(std::string_view what);
  void SkipBlanks();

  LineReader lines_;
  std::string path_;
  std::string_view rest_;
  std::vector<std::string_view> words_;
  int line_ = 0;
};

struct AshdownEntity {
  struct Patch {
    std::size_t surface = 0;  // index in AshdownEntity::surfaces
    Polygon3 corners;         // the three or four corners of the patch, in the coordinates of the entity
  };
  std::string name;                // the name of the entity's file, without its ending
  std::size_t vertices = 0;        // the number of vertices in the entity's file
  std::vector<Material> surfaces;  // the materials of the entity's surfaces, each with a name
  std::vector<Patch> patches;      // the patches of the entity, in the order of its file
  std::size_t elements = 0;        // the number of elements in the entity's file
  Vec3 step = Vec3::Zero();        // unit to which the vertices are rounded, for each axis of the entity
};

// Reads an entity from the text of the file `path`. As in the book's parser, keywords are not compared: any
// line that does not begin as an item of a section ends the section. An item that begins correctly and then
// deviates from the format is an error, whereas the book's parser ends the section there. Throws InputError
// with the message "FILE:LINE: error: what is wrong and how to mend it" for such items, for indices out of
// range, for sections without items, and for files that end too early.
AshdownEntity ReadAshdownEntity(std::string_view text, const std::string& path);

}  // namespace penumbra
