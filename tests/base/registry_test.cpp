// Registries of methods, and formats by the endings of files.

#include "solver/base/registry.h"

#include <gtest/gtest.h>

#include "solver/base/file_endings.h"

namespace penumbra {
namespace {

struct Shape {
  virtual ~Shape() = default;
  virtual double Area() const = 0;
};
struct Square final : Shape {
  explicit Square(double side_of_it) : side(side_of_it) {}
  double Area() const override { return side * side; }
  double side;
};
using Shapes = Registry<Shape, double>;

Shapes::Method SquareNamed(const std::string& name) {
  return {
      name, "as long as wide", {"side"}, [](const double& side) { return std::make_unique<Square>(side); }};
}

// Methods are listed in the order in which they were added; one that is added later is found like the others;
// a name that nobody has is refused with the list.
TEST(Registry, ListsAddsAndRefuses) {
  Shapes shapes("shape", {SquareNamed("square"), SquareNamed("box")});
  shapes.Add(SquareNamed("mine"));
  EXPECT_EQ(shapes.Names(), (std::vector<std::string>{"square", "box", "mine"}));
  EXPECT_EQ(shapes.Make("mine", 3)->Area(), 9);
  EXPECT_EQ(shapes.Find("box").parameters, std::vector<std::string>{"side"});
  try {
    shapes.Find("circle");
    ADD_FAILURE() << "a shape that does not exist was found";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "no shape is called 'circle'; give one of: square, box, mine");
  }
}

// A file's ending names its format; of others it is said which endings there are.
TEST(FileEndings, NameFormats) {
  const Shapes formats("format", {SquareNamed("png"), SquareNamed("exr")});
  ASSERT_NE(FindByEnding(formats, "a.b/c.exr"), nullptr);
  EXPECT_EQ(FindByEnding(formats, "a.b/c.exr")->name, "exr");
  for (const char* path : {"a.b/c", "png", ".png", "a.png.gz", "a.PNG", ""})
    EXPECT_EQ(FindByEnding(formats, path), nullptr) << path;
  EXPECT_EQ(EndingError("a", {"png"}), "'a' does not end in .png");
  EXPECT_EQ(EndingError("a", {"png", "exr"}), "'a' ends neither in .png nor in .exr");
  EXPECT_EQ(EndingError("a", {"vtu", "ply", "glb"}), "'a' ends in none of .vtu, .ply, .glb");
}

}  // namespace
}  // namespace penumbra
