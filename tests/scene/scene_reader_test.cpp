// Who reads and who writes a scene: readers by ending, content and name, writers by ending.

#include <gtest/gtest.h>

#include <fstream>

#include "solver/base/check.h"
#include "solver/base/file_endings.h"
#include "solver/scene/named_scene.h"
#include "solver/scene/obj_reader.h"
#include "solver/scene/scene_readers.h"
#include "solver/scene/scene_writers.h"
#include "tests/scene/temporary_folder.h"

namespace penumbra {
namespace {

constexpr std::string_view kMark = "square ";

// A format for one square: its mark and the length of its side. Told by its content.
class SquareReader final : public SceneReader {
 public:
  std::vector<std::string> Endings() const override { return {"square"}; }
  bool Recognises(const SceneSource& source) const override { return source.beginning.starts_with(kMark); }
  Scene Read(const std::string& name, const SceneOptions& options) const override {
    std::ifstream file(name);
    std::string mark, side;
    file >> mark >> side;
    const std::string obj =
        "v 0 0 0\nv " + side + " 0 0\nv " + side + " " + side + " 0\nv 0 " + side + " 0\nf 1 2 3 4\n";
    return ReadObjText(
        obj, name, [](std::string_view) { return std::nullopt; }, options);
  }
};

class FaceCounter final : public SceneWriter {
 public:
  std::vector<std::string> Texts(const Scene& scene, const Camera&, const std::string&) const override {
    return {std::to_string(scene.patches.size())};
  }
};

void AddToyFormats() {
  static const bool added = [] {
    SceneReaders().Add({"square", "a square", {}, [] { return std::make_unique<const SquareReader>(); }});
    SceneWriters().Add(
        {"count", "how many patches", {}, [] { return std::make_unique<const FaceCounter>(); }});
    return true;
  }();
  EXPECT_TRUE(added);
}

class SceneReaderTest : public scene_test::TestWithFolder {
 protected:
  SceneReaderTest() { AddToyFormats(); }
};

// A reader that a program adds reads its files, whatever they are called; OBJ is read by its ending, and
// where nobody knows the file; a name is a built-in scene only where there is no file.
TEST_F(SceneReaderTest, ChoosesByContentEndingAndName) {
  EXPECT_EQ(ReadNamedScene(Write("a.square", "square 2"), {}).patches.at(0).area, 4);
  EXPECT_EQ(ReadNamedScene(Write("no_ending", "square 3"), {}).patches.at(0).area, 9);
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  EXPECT_EQ(ReadNamedScene(Write("b.obj", obj), {}).patches.at(0).area, 0.5);
  EXPECT_EQ(ReadNamedScene(Write("b.txt", obj), {}).patches.at(0).area, 0.5);
  EXPECT_EQ(ReadNamedScene("furnace", {}).name, "furnace");
  EXPECT_THROW(ReadNamedScene("no such scene", {}), InputError);
  EXPECT_TRUE(HasSceneEnding("a.obj"));
  EXPECT_TRUE(HasSceneEnding("a.square"));
  EXPECT_FALSE(HasSceneEnding("a.png"));
}

// Readers and writers are listed, each with a line of help; a name that nobody has is refused.
TEST_F(SceneReaderTest, FormatsAreListed) {
  // OBJ is the first, for files that no other reader knows.
  EXPECT_EQ(SceneReaders().Names().front(), "obj");
  EXPECT_EQ(SceneReaders().Names().back(), "square");
  EXPECT_EQ(SceneWriters().Names().back(), "count");
  for (const auto& method : SceneReaders().methods()) EXPECT_FALSE(method.help.empty());
  for (const auto& method : SceneWriters().methods()) EXPECT_FALSE(method.help.empty());
  EXPECT_THROW(SceneReaders().Find("guess"), InputError);
  EXPECT_THROW(SceneWriters().Find("guess"), InputError);
}

// A writer is found by the ending of the file and says how many files it writes.
TEST_F(SceneReaderTest, WritersGoByEnding) {
  const Scene scene = ReadNamedScene("furnace", {});
  for (const auto& method : SceneWriters().methods()) {
    const std::string path = "folder/a." + method.name;
    const SceneWriterRegistry::Method* found = FindByEnding(SceneWriters(), path);
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->name, method.name);
    const auto writer = found->make();
    const std::vector<std::string> texts = writer->Texts(scene, scene.cameras.at(0), path);
    EXPECT_EQ(texts.size(), writer->FilesBeside(path).size() + 1) << method.name;
    EXPECT_FALSE(texts.back().empty());
  }
  EXPECT_EQ(SceneWriters().Make("obj")->FilesBeside("folder/a.obj"),
            std::vector<std::string>{"folder/a.mtl"});
  EXPECT_EQ(SceneWriters().Make("count")->Texts(scene, {}, "a.count").at(0), "6");
}

}  // namespace
}  // namespace penumbra
