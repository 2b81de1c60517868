// The window as a person uses it: real keys, buttons, drags and wheels, sent by the X server. What came of
// them is seen in the files that the window is asked to write.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stb/stb_image.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "test_paths.h"
#include "tests/apps/run_program.h"
#include "tests/window/virtual_display.h"

namespace penumbra {
namespace {

constexpr int kWide = 640, kHigh = 480;

std::string OutputOf(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return text;
  char part[256];
  while (std::fgets(part, sizeof part, pipe)) text += part;
  pclose(pipe);
  return text;
}

void Sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

class RealEvents : public testing::Test {
 protected:
  static void SetUpTestSuite() { display = new VirtualDisplay; }
  static void TearDownTestSuite() { delete display; }
  void SetUp() override {
    ASSERT_TRUE(display->ready()) << "no display: is Xvfb installed?";
    if (OutputOf("command -v xdotool").empty()) GTEST_SKIP() << "xdotool is not installed";
    setenv("XDG_STATE_HOME", sandbox.Path("state").c_str(), 1);
    std::filesystem::create_directories(sandbox.Path("state/penumbra"));
    sandbox.Write("state/penumbra/size", std::to_string(kWide) + "x" + std::to_string(kHigh));
  }
  void TearDown() override { End(); }

  // Opens the window and waits until it is there.
  void Open(const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {PENUMBRA_BINARY_DIR "/bin/penumbra", "view", "floating-cube", "--error",
                                      "0.2"};
    words.insert(words.end(), more.begin(), more.end());
    program_ = fork();
    if (program_ == 0) {
      std::vector<char*> arguments;
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      if (chdir(sandbox.Path("").c_str()) != 0) _exit(126);
      execv(arguments[0], arguments.data());
      _exit(127);
    }
    id_ = OutputOf("timeout 60 xdotool search --sync --onlyvisible --name '^Penumbra' 2>/dev/null | head -1");
    ASSERT_FALSE(id_.empty());
    id_.pop_back();
    Do("mousemove 320 240");
    Sleep(0.3);
  }
  // Commands of xdotool.
  void Do(const std::string& commands) {
    ASSERT_EQ(std::system(("xdotool " + commands).c_str()), 0) << commands;
  }
  void Keys(const std::string& keys) { Do("key --delay 40 " + keys); }
  void Type(const std::string& text) { Do("type --delay 15 '" + text + "'"); }

  // Saves what the picture shows now; waits until the file is there. The file comes after everything that the
  // solver had to do.
  std::vector<unsigned char> Picture(const std::string& name) {
    std::filesystem::remove(sandbox.Path(name));
    Keys("ctrl+p");
    Type(name);
    Keys("Return");
    for (int i = 0; i < 600 && !std::filesystem::exists(sandbox.Path(name)); ++i) Sleep(0.05);
    int width = 0, height = 0, channels = 0;
    unsigned char* data = stbi_load(sandbox.Path(name).c_str(), &width, &height, &channels, 3);
    EXPECT_NE(data, nullptr) << name;
    if (!data) return {};
    std::vector<unsigned char> rgb(data, data + static_cast<std::ptrdiff_t>(3) * width * height);
    stbi_image_free(data);
    return rgb;
  }
  // The picture once nothing changes it any more.
  std::vector<unsigned char> Settled(const std::string& name) {
    std::vector<unsigned char> before;
    for (int i = 0; i < 40; ++i) {
      std::vector<unsigned char> now = Picture(name);
      if (now == before) return now;
      before = std::move(now);
      Sleep(0.3);
    }
    ADD_FAILURE() << name << " does not settle";
    return before;
  }
  static double Different(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b) {
    if (a.size() != b.size() || a.empty()) return 1;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += std::abs(a[i] - b[i]) > 2 ? 1 : 0;
    return static_cast<double>(count) / static_cast<double>(a.size());
  }
  // True if the program ends within some seconds.
  bool Ended(double seconds) {
    for (double waited = 0; waited < seconds && program_ > 0; waited += 0.05) {
      int status = 0;
      if (waitpid(program_, &status, WNOHANG) == program_) {
        program_ = -1;
        exit_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        return true;
      }
      Sleep(0.05);
    }
    return program_ < 0;
  }
  void End() {
    if (program_ <= 0) return;
    kill(program_, SIGKILL);
    waitpid(program_, nullptr, 0);
    program_ = -1;
  }

  static VirtualDisplay* display;
  Sandbox sandbox;
  pid_t program_ = -1;
  int exit_ = -1;
  std::string id_;  // of the window
};
VirtualDisplay* RealEvents::display = nullptr;

// A scene's name that is wrong stays in its dialog, and the letters that follow it: `o`, `f`, `m` would draw
// false colours, no faces, elements.
TEST_F(RealEvents, TypedTextIsNeverAShortcut) {
  Open();
  const auto before = Settled("before.png");
  Keys("ctrl+o");
  Type("nosuch");
  Keys("Return");
  Type("ofmtxzv12345");
  Keys("Escape");
  EXPECT_LT(Different(before, Picture("after.png")), 0.001);
  // The same letters do something where no field has the keys.
  Keys("o");
  EXPECT_GT(Different(before, Picture("false.png")), 0.2);
}

// What keys did, ctrl+z takes back, and ctrl+shift+z does again.
TEST_F(RealEvents, UndoAndRedo) {
  Open();
  const auto before = Settled("before.png");
  Keys("o");
  const auto coloured = Picture("coloured.png");
  EXPECT_GT(Different(before, coloured), 0.2);
  Keys("ctrl+z");
  EXPECT_LT(Different(before, Picture("undone.png")), 0.001);
  Keys("ctrl+shift+z");
  EXPECT_LT(Different(coloured, Picture("redone.png")), 0.001);
}

// An iteration on a solved scene is taken back with its interpolants: nothing is lost by a key.
TEST_F(RealEvents, AnIterationIsTakenBack) {
  Open();
  const auto before = Settled("before.png");
  Do("mousemove 320 240");
  Keys("i");
  Sleep(1);
  Keys("ctrl+z");
  EXPECT_LT(Different(before, Settled("undone.png")), 0.001);
}

// A drag turns the view, the wheel moves it nearer, h brings it back.
TEST_F(RealEvents, DragsAndWheels) {
  Open();
  const auto before = Settled("before.png");
  Do("mousemove 320 240 sleep 0.1 mousedown 1 sleep 0.1 mousemove 340 250 sleep 0.1 mousemove 400 280 sleep "
     "0.1 mouseup 1");
  EXPECT_GT(Different(before, Picture("turned.png")), 0.05);
  Keys("h");
  EXPECT_LT(Different(before, Picture("home.png")), 0.001);
  Do("click 4 click 4 click 4");
  EXPECT_GT(Different(before, Picture("nearer.png")), 0.05);
}

// A click selects, and escape ends it.
TEST_F(RealEvents, AClickSelects) {
  Open();
  const auto before = Settled("before.png");
  Do("mousemove 320 400 click 1");
  Sleep(0.5);
  EXPECT_GT(Different(before, Picture("selected.png")), 0.002);
  Keys("Escape");
  EXPECT_LT(Different(before, Picture("free.png")), 0.001);
}

// The window follows a change of its size: a saved picture has the new one.
TEST_F(RealEvents, IsResized) {
  Open();
  Sleep(2);
  Do("windowsize --sync " + id_ + " 500 400");
  Sleep(0.5);
  EXPECT_EQ(Picture("resized.png").size(), 3U * 500 * 400);
}

// Unsaved work is asked about: escape stays, and the keys are the question's while it is open.
TEST_F(RealEvents, QuitAsksFirst) {
  sandbox.Write("state/penumbra/panels", "ask-above 0\n");
  Open();
  const auto before = Settled("before.png");
  Keys("ctrl+q");
  Keys("o");
  EXPECT_FALSE(Ended(1));
  Keys("Escape");
  EXPECT_LT(Different(before, Picture("stays.png")), 0.001);
}

// Without work to lose the window ends at once.
TEST_F(RealEvents, QuitEndsWhereNothingIsLost) {
  Open({"--no-solve"});
  Keys("ctrl+q");
  EXPECT_TRUE(Ended(10));
  EXPECT_EQ(exit_, 0);
}

// Without a solve, the first picture shows the scene: it is neither black nor of one colour.
TEST_F(RealEvents, TheFirstPictureIsNotBlack) {
  Open({"--no-solve"});
  const auto first = Picture("first.png");
  ASSERT_FALSE(first.empty());
  std::size_t bright = 0;
  for (const unsigned char c : first) bright += c > 100 ? 1 : 0;
  EXPECT_GT(static_cast<double>(bright), 0.2 * static_cast<double>(first.size()));
}

// Steps come with `>`, and go back with `<`: the picture is that of before.
TEST_F(RealEvents, StepsGoBackAndOn) {
  Open({"--no-solve"});
  Keys("greater greater greater");
  Sleep(1);
  const auto third = Picture("third.png");
  // So many that links are split: before, the floor has one colour, which the exposure makes the same.
  Keys("greater greater greater greater greater greater greater greater greater");
  Sleep(2);
  EXPECT_GT(Different(third, Picture("twelfth.png")), 0.001);
  Keys("less less less less less less less less less");
  Sleep(1);
  EXPECT_LT(Different(third, Picture("back.png")), 0.001);
}

// Two clicks draw a line on the floor, yellow in the picture, and ctrl+z takes it away.
TEST_F(RealEvents, ALineIsDrawnByTwoClicks) {
  Open();
  const auto yellow = [](const std::vector<unsigned char>& rgb) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < rgb.size(); i += 3)
      count += rgb[i] > 200 && rgb[i + 1] > 170 && rgb[i + 2] < 110 ? 1 : 0;
    return count;
  };
  const std::size_t before = yellow(Settled("before.png"));
  Keys("ctrl+g");
  Do("mousemove 260 400 click 1");
  Sleep(0.3);
  Do("mousemove 380 400 click 1");
  Sleep(1);
  EXPECT_GT(yellow(Picture("line.png")), before + 100);
  Keys("ctrl+z");
  Sleep(0.5);
  EXPECT_LT(yellow(Settled("none.png")), before + 20);
}

// A dimmer is dragged: the picture darkens without a solve, and ctrl+z brings the light back.
TEST_F(RealEvents, ADimmerIsDragged) {
  Open();
  const auto sum = [](const std::vector<unsigned char>& rgb) {
    double total = 0;
    for (const unsigned char c : rgb) total += c;
    return total;
  };
  Settled("solved.png");
  Keys("bracketleft");  // exposure by hand
  const auto before = Settled("before.png");
  Keys("ctrl+l");
  Sleep(0.5);
  Do("mousemove 95 90 mousedown 1 mousemove 80 90");
  Sleep(0.3);
  Do("mousemove 48 90 mouseup 1");
  Sleep(2);
  Do("mousemove 600 450");
  EXPECT_LT(sum(Settled("dimmed.png")), 0.95 * sum(before));
  Keys("ctrl+z");
  Sleep(1);
  EXPECT_LT(Different(before, Settled("bright.png")), 0.001);
}

}  // namespace
}  // namespace penumbra
