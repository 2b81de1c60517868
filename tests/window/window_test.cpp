// The window as a user sees it, on a display without a screen: scripts play what he would do, and screenshots
// show what came of it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/apps/run_program.h"
#include "tests/window/virtual_display.h"

namespace penumbra {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class Window : public testing::Test {
 protected:
  Window() {
    // What is remembered between sessions goes into the sandbox.
    setenv("XDG_STATE_HOME", sandbox.Path("state").c_str(), 1);
  }
  Outcome Play(const std::string& script, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"view", "floating-cube", "--error",
                                          "0.2",  "--script",      sandbox.Write("script", script)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return sandbox.Run(arguments);
  }
  // What `view --help-script` lists between a line and the next that is empty: the words before the help.
  std::vector<std::string> ListedSources(const std::string& heading) {
    std::vector<std::string> found;
    bool inside = false;
    for (const std::string& line : Lines(sandbox.Run({"view", "x", "--help-script"}).out)) {
      if (line.empty()) inside = false;
      if (inside) found.push_back(line);
      if (line.starts_with(heading)) inside = true;
    }
    return found;
  }
  struct Shot {
    int width = 0, height = 0;
    std::vector<unsigned char> rgb;
    std::size_t Different(const Shot& other) const {
      if (rgb.size() != other.rgb.size()) return rgb.size() + other.rgb.size();
      std::size_t count = 0;
      for (std::size_t i = 0; i < rgb.size(); i += 3)
        count += rgb[i] != other.rgb[i] || rgb[i + 1] != other.rgb[i + 1] || rgb[i + 2] != other.rgb[i + 2]
                     ? 1
                     : 0;
      return count;
    }
  };
  Shot Load(const std::string& name) {
    Shot shot;
    int channels = 0;
    unsigned char* data = stbi_load(sandbox.Path(name).c_str(), &shot.width, &shot.height, &channels, 3);
    EXPECT_NE(data, nullptr) << name;
    if (!data) return shot;
    shot.rgb.assign(data, data + static_cast<std::ptrdiff_t>(3) * shot.width * shot.height);
    stbi_image_free(data);
    return shot;
  }

  static void SetUpTestSuite() { display = new VirtualDisplay; }
  static void TearDownTestSuite() { delete display; }
  void SetUp() override { ASSERT_TRUE(display->ready()) << "no display: is Xvfb installed?"; }

  static VirtualDisplay* display;
  Sandbox sandbox;
};
VirtualDisplay* Window::display = nullptr;

TEST_F(Window, SolvesAndShowsEveryVisualisation) {
  const Outcome run = Play(R"(
resize 480x360
screenshot before.png
key c
wait idle
screenshot solved.png
set mode flat
key m
screenshot mesh.png
key m
key t
wait idle
screenshot triangles.png
key t
key x
wait idle
screenshot discontinuities.png
key x
set visible-links on
set partial-links on
set split-links on
screenshot links.png
set visible-links off
set partial-links off
set split-links off
set mode interpolant
key v
wait idle
screenshot split.png
key v
key o
screenshot false-colour.png
key o
key e
wait idle
screenshot error.png
key e
key f
screenshot no-faces.png
)",
                           {"--no-solve"});
  EXPECT_EQ(run.status, 0) << run.err;
  const Shot solved = Load("solved.png");
  EXPECT_EQ(solved.width, 480);
  EXPECT_EQ(solved.height, 360);
  for (const char* name : {"before", "mesh", "triangles", "discontinuities", "links", "split", "false-colour",
                           "error", "no-faces"})
    EXPECT_GT(Load(std::string(name) + ".png").Different(solved), 500U) << name;
}

TEST_F(Window, PanelsMenusAndDialogsHearMouseAndKeys) {
  const Outcome run = Play(R"(
resize 640x480
wait idle
screenshot plain.png
key d
screenshot panel.png
key d
key ?
screenshot help.png
key ?
screenshot plain-again.png
mouse click left 20 8
screenshot menu.png
key escape
mouse click left 500 400
key ctrl+k
wait frames 2
type corner
key enter
wait frames 2
set camera corner
key ctrl+k
wait frames 2
key escape
key d
screenshot panel-again.png
key d
key ctrl+o
wait frames 2
type nowhere.obj
key enter
screenshot message.png
)");
  EXPECT_EQ(run.status, 0) << run.err;
  const Shot plain = Load("plain.png");
  EXPECT_EQ(Load("plain-again.png").Different(plain), 0U);
  for (const char* name : {"panel", "panel-again", "help", "menu", "message"})
    EXPECT_GT(Load(std::string(name) + ".png").Different(plain), 1000U) << name;
}

// While the mouse looks around it is for nothing else: no panel hears it, wherever it would be.
TEST_F(Window, TheMouseThatLooksAroundOpensNoMenu) {
  const Outcome run = Play(R"(
resize 640x480
set hover off
wait idle
mouse move 300 300
screenshot plain.png
set navigation walk
set mouse-look on
mouse click left 20 8
set navigation arcball
menu Viewing/Home
screenshot after.png
set mouse-look off
mouse click left 20 8
screenshot menu.png
)");
  EXPECT_EQ(run.status, 0) << run.err;
  const Shot plain = Load("plain.png");
  EXPECT_LT(Load("after.png").Different(plain), 100U);
  EXPECT_GT(Load("menu.png").Different(plain), 1000U);
}

TEST_F(Window, ProbesPrintWhatTheProbeCommandMeasures) {
  const Outcome run = Play("resize 400x300\nwait idle\nmouse click right 200 240\nwait idle\n");
  EXPECT_EQ(run.status, 0) << run.err;
  const std::vector<std::string> lines = Lines(run.out);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[0], StartsWith("x,y,z,patch,exact_r"));
  const std::vector<std::string> shown = Fields(lines[1]);
  ASSERT_EQ(shown.size(), 13U);
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n" + shown[0] + "," + shown[1] + "," + shown[2] + ",0,0,1\n");
  const Outcome probe =
      sandbox.Run({"probe", "floating-cube", "--error", "0.2", "--points", sandbox.Path("points.csv")});
  const std::vector<std::string> wanted = Fields(Lines(probe.out).at(1));
  EXPECT_EQ(shown[3], wanted[6]);  // patch
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(std::stod(shown[4 + i]), std::stod(wanted[7 + i]), 1e-6 * std::stod(wanted[7 + i])) << i;
}

TEST_F(Window, SurvivesAnySizeAndAnEndAtAnyTime) {
  for (const char* script :
       {"resize 1x1\nwait idle\nscreenshot a.png\n", "quit", "", "wait frames 3\nquit",
        "wait idle\nmouse scroll -8000\nwait frames 3\nmouse scroll 8000\nwait frames 3\nmouse scroll 9e99\n"
        "wait frames 3\nset navigation walk\nmouse scroll -9e99\nwait frames 3\nmouse scroll 9e99\nkey w",
        "resize 1400x3\nkey d\nwait frames 3\nresize 3x1000\nwait frames 3\n",
        "wait frames 5\nkey backspace\nwait idle\nkey c\nwait idle\nkey ctrl+q\nwait seconds 60"}) {
    const Outcome run = Play(script);
    EXPECT_EQ(run.status, 0) << script << run.err;
  }
  EXPECT_EQ(Load("a.png").width, 1);
}

TEST_F(Window, ScriptsLeaveNothingBehind) {
  EXPECT_EQ(Play("wait frames 2").status, 0);
  EXPECT_FALSE(std::filesystem::exists(sandbox.Path("state")));
}

TEST_F(Window, ErrorsAreOneLineAndStatusOne) {
  const Outcome wrong = Play("wait frames 1\nset mode nonsense\n");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_THAT(wrong.err, HasSubstr("script:2: error: mode: 'nonsense' is none of flat"));
  const Outcome unwritable = Play("screenshot no/such/folder/a.png");
  EXPECT_EQ(unwritable.status, 1);
  EXPECT_THAT(unwritable.err, HasSubstr("a.png"));
  const Outcome missing = sandbox.Run({"view", "nowhere.obj", "--script", sandbox.Write("s", "quit")});
  EXPECT_EQ(missing.status, 1);
  EXPECT_EQ(Lines(missing.err).size(), 1U);
}

// Every menu item by its path and by its key, and every option with each of its choices: nothing fails but
// what names files, and the window lives on.
TEST_F(Window, EveryMenuItemKeyAndOption) {
  std::string script = "resize 320x240\nwait idle\n";
  std::size_t items = 0, options = 0;
  for (const std::string& line : ListedSources("Menus")) {
    // Two columns: the path, then the key.
    const std::string path = line.substr(2, line.find("  ", 2) - 2);
    const std::size_t last = line.find_last_not_of(' ');
    const std::string key = last >= 55 ? line.substr(55, last - 54) : "";
    ++items;
    if (path.starts_with("File/Quit")) continue;
    const bool dialog = path.ends_with("...");
    script += "menu " + path + "\nwait frames 2\n" + (dialog ? "key escape\nwait frames 2\n" : "");
    if (!key.empty())
      script += "key " + key + "\nwait frames 2\n" + (dialog ? "key escape\nwait frames 2\n" : "");
  }
  EXPECT_GT(items, 50U);
  script += "set mode flat\nset navigation arcball\nkey escape\nwait idle\n";
  for (const std::string& line : ListedSources("Options for")) {
    const std::string name = line.substr(2, line.find(' ', 2) - 2);
    const std::string values = line.substr(line.rfind('(') + 1, line.rfind(')') - line.rfind('(') - 1);
    ++options;
    if (values.find('|') == std::string::npos) {
      if (!values.empty() && values.find(' ') == std::string::npos && values.back() != ')')
        script += "set " + name + " " + values + "\n";
      continue;
    }
    std::istringstream choices(values);
    for (std::string choice; std::getline(choices, choice, '|');)
      script += "set " + name + " " + choice + "\nwait frames 1\n";
    script += "set " + name + " " + values.substr(0, values.find('|')) + "\n";
  }
  EXPECT_GT(options, 50U);
  script += "screenshot last.png\nmenu File/Quit\nwait seconds 60\n";
  const Outcome run = Play(script);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(Load("last.png").width, 320);
}

// How a scene is read can be changed while it is looked at: what is solved then is what `solve` makes with
// these options.
TEST_F(Window, ReadsItsSceneAnew) {
  const Outcome changed = Play(R"(
resize 64x48
wait idle
set two-sided on
set emittance left_light=300,200,100
set max-reflectance 0.5
set max-reflectance none
wait idle
set save-solution a.h5
wait idle
)");
  EXPECT_EQ(changed.status, 0) << changed.err;
  const Outcome solved = sandbox.Run({"solve", "floating-cube", "--error", "0.2", "--two-sided",
                                      "--emittance", "left_light=300,200,100", "-o", "b.h5"});
  EXPECT_EQ(solved.status, 0) << solved.err;
  EXPECT_EQ(ReadBytes(sandbox.Path("a.h5")), ReadBytes(sandbox.Path("b.h5")));
  const Outcome wrong = Play("wait idle\nset emittance nothing=1,1,1\n");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_THAT(wrong.err, HasSubstr("script:2: error: emittance: the scene has no material 'nothing'"));
  EXPECT_EQ(Play("wait idle\nset two-sided maybe\n").status, 1);
}

// The report is that of `solve --report`, but for times and memory; of a solution, that of `info --report`.
TEST_F(Window, SavesTheReport) {
  const auto lasting = [&](const std::string& name) {
    nlohmann::json report = nlohmann::json::parse(ReadBytes(sandbox.Path(name)));
    for (const char* part : {"phases", "memory_peak_bytes", "threads"}) report.erase(part);
    for (nlohmann::json& iteration : report["iterations"]) iteration.erase("seconds");
    return report;
  };
  const Outcome saved = Play("wait idle\nset save-report a.json\nset save-solution a.h5\nwait idle\n");
  EXPECT_EQ(saved.status, 0) << saved.err;
  EXPECT_EQ(sandbox.Run({"solve", "floating-cube", "--error", "0.2", "--report", "b.json"}).status, 0);
  EXPECT_EQ(lasting("a.json"), lasting("b.json"));
  const Outcome again = sandbox.Run(
      {"view", "a.h5", "--script", sandbox.Write("s", "wait idle\nset save-report c.json\nwait idle\n")});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(sandbox.Run({"info", "a.h5", "--report", "d.json"}).status, 0);
  EXPECT_EQ(lasting("c.json"), lasting("d.json"));
}

// Links of a solution are gone on with, and materials changed over them: as by `solve --restart`, to the
// byte, whether the window began so or not; without them the scene is solved anew by the options of before.
TEST_F(Window, LightsItsSceneOverTheLinksOfASolution) {
  const std::vector<std::string> solve = {"solve", "floating-cube", "--error", "0.2"};
  const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const std::vector<std::string> light = {"--emittance", "left_light=0,0,9"};
  const std::vector<std::string> over = with(light, {"--restart", "links.h5"});
  ASSERT_EQ(sandbox.Run(with(solve, {"--eps", "0.5", "-o", "links.h5"})).status, 0);
  ASSERT_EQ(sandbox.Run(with(with(solve, over), {"-o", "over.h5"})).status, 0);
  ASSERT_EQ(sandbox.Run(with(with(solve, light), {"-o", "anew.h5"})).status, 0);
  const Outcome changed = Play(R"(
resize 64x48
wait idle
set restart links.h5
wait frames 2
set emittance left_light=0,0,9
wait idle
set save-solution a.h5
wait idle
menu Iteration/Iterate
menu Iteration/Correct
wait idle
set error-points 10
menu Iteration/Link
wait idle
menu Iteration/Iterate to convergence
wait idle
set error-points 1000
set save-solution b.h5
wait idle
set restart none
wait idle
set save-solution c.h5
wait idle
)");
  EXPECT_EQ(changed.status, 0) << changed.err;
  const Outcome begun = Play("resize 64x48\nwait idle\nset save-solution d.h5\nwait idle\n", over);
  EXPECT_EQ(begun.status, 0) << begun.err;
  for (const char* name : {"a.h5", "b.h5", "d.h5"})
    EXPECT_TRUE(ReadBytes(sandbox.Path(name)) == ReadBytes(sandbox.Path("over.h5"))) << name;
  EXPECT_TRUE(ReadBytes(sandbox.Path("c.h5")) == ReadBytes(sandbox.Path("anew.h5")));
  for (const auto& [script, says] : {std::pair("set eps 1", "eps: it says how links are made"),
                                     {"set two-sided on", "it is no solution of"},
                                     {"set restart nowhere.h5", "restart: nowhere.h5: error: there is no"}}) {
    const Outcome wrong = Play(script, over);
    EXPECT_EQ(wrong.status, 1) << script;
    EXPECT_THAT(wrong.err, HasSubstr(says));
  }
}

// A solution is saved, exported and opened again: as another program run, and in the window.
TEST_F(Window, SavesOpensAndExportsSolutions) {
  const Outcome saved = Play(R"(
resize 300x200
wait idle
screenshot solved.png
set save-solution a.h5
set export a.ply
set export a.obj
set supersampling 2
set save-picture a.png
wait idle
set mode exact
wait idle
screenshot exact.png
set mode lerp
wait idle
screenshot lerp.png
set open a.h5
set mode interpolant
wait idle
screenshot opened.png
)");
  EXPECT_EQ(saved.status, 0) << saved.err;
  for (const char* name : {"a.h5", "a.ply", "a.obj", "a.mtl", "a.png"})
    EXPECT_TRUE(std::filesystem::exists(sandbox.Path(name))) << name;
  const Shot solved = Load("solved.png");
  EXPECT_LT(Load("lerp.png").Different(solved), 300U * 200 / 20);
  EXPECT_LT(Load("opened.png").Different(solved), 2000U);  // frames per second, say
  EXPECT_GT(Load("exact.png").Different(solved), 0U);
  const Outcome again = sandbox.Run({"view", "a.h5", "--script", sandbox.Write("s", R"(
resize 300x200
wait idle
screenshot again.png
set save-solution b.h5
wait idle
)")});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_LT(Load("again.png").Different(solved), 2000U);
  // What was solved is what `solve` solves, to the byte, and goes through the window unchanged.
  const Outcome solve = sandbox.Run({"solve", "floating-cube", "--error", "0.2", "-o", "c.h5"});
  EXPECT_EQ(solve.status, 0) << solve.err;
  EXPECT_TRUE(ReadBytes(sandbox.Path("a.h5")) == ReadBytes(sandbox.Path("c.h5")));
  EXPECT_TRUE(ReadBytes(sandbox.Path("a.h5")) == ReadBytes(sandbox.Path("b.h5")));
}

// Live light from a script: dimmed over the kept transport, the picture is that of the dimmed scene solved
// anew, within the error; undo brings the first picture back; what is saved says what was dimmed.
TEST_F(Window, LampsArePlayedByScripts) {
  const Outcome dimmed = Play(R"(
resize 300x200
set hover off
set auto-exposure off
set exposure 0.003
wait idle
set save-picture before.png
wait idle
set dim left_light=0.25,0.5,1
wait idle
set save-picture dimmed.png
set save-solution dimmed.h5
wait idle
key ctrl+z
wait idle
set save-picture undone.png
wait idle
key ctrl+shift+z
wait idle
menu Iteration/Iterate to convergence
wait idle
set save-picture solved.png
wait idle
set lamps on
screenshot lamps.png
)");
  EXPECT_EQ(dimmed.status, 0) << dimmed.err;
  const Shot before = Load("before.png"), after = Load("dimmed.png"), solved = Load("solved.png");
  EXPECT_GT(after.Different(before), 10'000U);
  EXPECT_EQ(Load("undone.png").Different(before), 0U);
  double difference = 0;
  for (std::size_t i = 0; i < after.rgb.size(); ++i) difference += std::abs(after.rgb[i] - solved.rgb[i]);
  std::printf("dimmed against solved anew: %.3g codes of 255\n",
              difference / static_cast<double>(after.rgb.size()));
  EXPECT_LT(difference / static_cast<double>(after.rgb.size()), 6);
  const Outcome info = sandbox.Run({"info", "dimmed.h5"});
  EXPECT_EQ(info.status, 0) << info.err;
  const Outcome again = sandbox.Run({"view", "dimmed.h5", "--script", sandbox.Write("s", R"(
resize 300x200
set auto-exposure off
set exposure 0.003
wait idle
set save-picture again.png
wait idle
)")});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(Load("again.png").Different(after), 0U);
}

// Steps, the time line, a plot and a question, from a script.
TEST_F(Window, StepsAndPlotsArePlayedByScripts) {
  const Outcome run = Play(R"(
resize 900x600
screenshot first.png
set time-line on
menu Iteration/Step
wait idle
menu Iteration/Step
wait idle
screenshot bounce.png
menu Iteration/Play
wait idle
screenshot played.png
set step 2
wait idle
screenshot back.png
menu Iteration/Play
wait idle
set time-line off
set line -1,-1,0 1,-1,0
wait idle
screenshot plot.png
set save-line line.csv
set ask-above 0
menu File/Quit
wait frames 3
screenshot question.png
key escape
wait frames 3
screenshot stays.png
menu File/Quit without saving
wait seconds 60
)",
                           {"--no-solve"});
  EXPECT_EQ(run.status, 0) << run.err;
  const Shot bounce = Load("bounce.png"), plot = Load("plot.png");
  EXPECT_GT(Load("first.png").Different(bounce), 10'000U);
  EXPECT_GT(Load("played.png").Different(bounce), 5'000U);
  EXPECT_GT(Load("question.png").Different(plot), 1'000U);
  EXPECT_LT(Load("stays.png").Different(plot), 500U);
  EXPECT_GT(Lines(ReadBytes(sandbox.Path("line.csv"))).size(), 100U);
}

// A script that plays every action which the help of scripts names.
TEST_F(Window, ScriptsUseTheWholeLanguage) {
  const std::string played = R"(
resize 400x300
key d
key down a
key up a
type a word
mouse move 5 5
mouse press left
mouse release left
mouse click middle 5 5
mouse double-click left 9 9
mouse drag shift+left 50 50 60 60
mouse scroll 1
menu Viewing/Home
set mode flat
wait idle
wait frames 1
wait seconds 0.1
screenshot a.png
quit
)";
  EXPECT_EQ(Play(played).status, 0);
  std::size_t actions = 0;
  for (const std::string& line : ListedSources("A script has an action")) {
    const std::string text = line.substr(0, line.find("  ", 2));
    // `mouse press|release BUTTON` names two actions: words in capitals are values.
    std::istringstream words(text);
    std::vector<std::string> ways = {""};
    for (std::string word; words >> word;) {
      if (word == "key" && !ways[0].empty()) break;  // the same, for letting go
      if (std::isupper(static_cast<unsigned char>(word[0])) || word[0] == '[' || word.ends_with(',')) break;
      std::vector<std::string> longer;
      std::istringstream choices(word);
      for (std::string choice; std::getline(choices, choice, '|');)
        for (const std::string& way : ways) longer.push_back(way + choice + " ");
      ways = longer;
    }
    for (std::string way : ways) {
      way.pop_back();
      EXPECT_THAT(played, HasSubstr("\n" + way)) << line;
      ++actions;
    }
  }
  EXPECT_GT(actions, 14U);
}

// Last, since it takes the display away.
TEST_F(Window, WithoutADisplayThereIsOneLine) {
  const std::string name = std::getenv("DISPLAY");
  unsetenv("DISPLAY");
  const Outcome run = sandbox.Run({"view", "floating-cube"});
  setenv("DISPLAY", name.c_str(), 1);
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(Lines(run.err).size(), 1U) << run.err;
  EXPECT_THAT(run.err, HasSubstr("no display"));
}

}  // namespace
}  // namespace penumbra
