#include "display/exr_image.h"
#include "display/png_image.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STB_IMAGE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include "solver/base/check.h"
#include "solver/base/random.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

class ImageIo : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("penumbra_image_io_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string Path(const std::string& name) const { return (folder_ / name).string(); }

  static std::string Bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void Put(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

  std::vector<std::string> Files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename());
    return names;
  }

  fs::path folder_;
};

Srgb8Image RandomScreen(int width, int height) {
  Random random(1);
  Srgb8Image image;
  image.Resize(width, height);
  for (std::uint8_t& value : image.pixels) value = static_cast<std::uint8_t>(random.Index(256));
  return image;
}

RgbImage RandomLinear(int width, int height) {
  Random random(2);
  RgbImage image(width, height);
  for (auto& plane : image.channel)
    for (float& value : plane) value = static_cast<float>(random.LogUniform(1e-30, 1e30));
  return image;
}

// No file may grow past `bytes` while one of these lives: a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

// A PNG holds exactly the pixels that were written, whatever the picture's size.
TEST_F(ImageIo, PngKeepsEveryPixel) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {31, 1}, {101, 67}}) {
    const Srgb8Image image = RandomScreen(width, height);
    WritePng(Path("a.png"), image);
    int w = 0, h = 0, channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> read(
        stbi_load(Path("a.png").c_str(), &w, &h, &channels, 0), stbi_image_free);
    ASSERT_NE(read, nullptr);
    EXPECT_EQ(w, width);
    EXPECT_EQ(h, height);
    ASSERT_EQ(channels, 3);
    EXPECT_EQ(std::memcmp(read.get(), image.pixels.data(), image.pixels.size()), 0);
  }
}

// An EXR gives back the floats that were written, bit by bit: huge, tiny, negative and infinite ones too.
TEST_F(ImageIo, ExrKeepsEveryBit) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {31, 1}, {101, 67}}) {
    RgbImage image = RandomLinear(width, height);
    image.channel[0][0] = std::numeric_limits<float>::denorm_min();
    image.channel[1][0] = -0.0f;
    image.channel[2][0] = std::numeric_limits<float>::infinity();
    WriteExr(Path("a.exr"), image);
    const RgbImage read = ReadExr(Path("a.exr"));
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.height, height);
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(read.channel[c].size(), image.channel[c].size());
      EXPECT_EQ(std::memcmp(read.channel[c].data(), image.channel[c].data(),
                            sizeof(float) * image.channel[c].size()),
                0);
    }
  }
}

// The same pixels give the same bytes, and writing leaves nothing but the file.
TEST_F(ImageIo, WritesTheSameBytesAgain) {
  const Srgb8Image screen = RandomScreen(40, 30);
  const RgbImage linear = RandomLinear(40, 30);
  for (const char* name : {"1", "2"}) {
    WritePng(Path(std::string(name) + ".png"), screen);
    WriteExr(Path(std::string(name) + ".exr"), linear);
  }
  EXPECT_EQ(Bytes(Path("1.png")), Bytes(Path("2.png")));
  EXPECT_EQ(Bytes(Path("1.exr")), Bytes(Path("2.exr")));
  EXPECT_EQ(Files().size(), 4u);
}

// Whether a picture is small or large, a disk that fills up leaves the old file whole, and no other behind.
TEST_F(ImageIo, AFullDiskLeavesTheOldFileWhole) {
  for (const int size : {4, 200})
    for (const rlim_t limit : {rlim_t{0}, rlim_t{20}, rlim_t{300}}) {
      for (const char* name : {"old.png", "old.exr"}) Put(Path(name), "old");
      {
        const FileSizeLimit full(size == 4 ? std::min<rlim_t>(limit, 20) : limit);
        EXPECT_THROW(WritePng(Path("old.png"), RandomScreen(size, size)), InputError) << size << ' ' << limit;
        EXPECT_THROW(WriteExr(Path("old.exr"), RandomLinear(size, size)), InputError) << size << ' ' << limit;
      }
      for (const char* name : {"old.png", "old.exr"})
        EXPECT_EQ(Bytes(Path(name)), "old") << size << ' ' << limit;
      EXPECT_EQ(Files().size(), 2u);
    }
}

// A place that cannot be written is named in the message; a folder in the file's place stays.
TEST_F(ImageIo, NamesThePlaceThatCannotBeWritten) {
  fs::create_directories(Path("folder.png"));
  const std::vector<std::string> places = {Path("folder.png"), Path("missing/a.png")};
  for (const std::string& path : places) {
    for (const bool exr : {false, true}) {
      try {
        exr ? WriteExr(path, RandomLinear(2, 2)) : WritePng(path, RandomScreen(2, 2));
        FAIL() << path;
      } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).rfind(path + ": error: ", 0), 0u) << error.what();
      }
    }
  }
  EXPECT_TRUE(fs::is_directory(Path("folder.png")));
  EXPECT_EQ(Files().size(), 1u);
}

// What is no EXR file is refused with its name: a missing file, another format, a file cut short.
TEST_F(ImageIo, RefusesWhatIsNoExr) {
  WriteExr(Path("whole.exr"), RandomLinear(50, 40));
  const std::string whole = Bytes(Path("whole.exr"));
  Put(Path("cut.exr"), whole.substr(0, whole.size() / 2));
  Put(Path("empty.exr"), "");
  Put(Path("text.exr"), "not a picture");
  std::string other = whole;  // with a channel of another name: "R", and its type
  other[other.find(std::string("R\0\2\0\0\0", 6))] = 'Z';
  Put(Path("channels.exr"), other);
  for (const char* name : {"missing.exr", "cut.exr", "empty.exr", "text.exr", "channels.exr"}) {
    try {
      ReadExr(Path(name));
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(Path(name) + ": error: "), std::string::npos) << error.what();
    }
  }
}

// Supersampling's filter is the mean of each block.
TEST(Downsample, TakesTheMeanOfEachBlock) {
  RgbImage image(6, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 6; ++x)
      image.Set(x, y, {static_cast<float>(x), static_cast<float>(y), static_cast<float>(x * y)});
  const RgbImage half = Downsample(image, 2, 2);
  ASSERT_EQ(half.width, 3);
  ASSERT_EQ(half.height, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      const float mx = 2 * static_cast<float>(x) + 0.5f, my = 2 * static_cast<float>(y) + 0.5f;
      EXPECT_EQ(half.At(x, y), (glm::vec3{mx, my, mx * my}));
    }
  EXPECT_EQ(Downsample(image, 1, 1).channel, image.channel);
  const RgbImage narrow = Downsample(image, 3, 1);
  ASSERT_EQ(narrow.width, 2);
  ASSERT_EQ(narrow.height, 4);
  EXPECT_EQ(narrow.At(1, 3), (glm::vec3{4, 3, 12}));
}

}  // namespace
}  // namespace penumbra
