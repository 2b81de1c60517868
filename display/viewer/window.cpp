// The window: GLFW and OpenGL carry the picture and Dear ImGui's panels to the screen, and keys and mouse
// back. Everything else is in Viewer, which knows of none of them.

#include "display/viewer/window.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <cfloat>
#include <chrono>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "display/png_image.h"
#include "display/viewer/panels.h"
#include "solver/base/check.h"

namespace penumbra::viewer {
namespace {

constexpr int kWidth = 1280, kHeight = 800;
constexpr double kRestSeconds = 0.1;  // between frames when nothing happens
constexpr int kMostHeldFrames = 10;   // a field that needs more to open is not seen at all

std::string& LastError() {
  static std::string error;
  return error;
}
void KeepError(int, const char* text) { LastError() = text; }

// A key of GLFW by our name; empty for those that we do not know.
std::string KeyName(int key) {
  if (key > GLFW_KEY_SPACE && key <= GLFW_KEY_GRAVE_ACCENT) {
    const auto c = static_cast<char>(key);
    return {c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c};
  }
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return fmt::format("f{}", key - GLFW_KEY_F1 + 1);
  switch (key) {
    case GLFW_KEY_SPACE:
      return "space";
    case GLFW_KEY_ESCAPE:
      return "escape";
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return "enter";
    case GLFW_KEY_TAB:
      return "tab";
    case GLFW_KEY_BACKSPACE:
      return "backspace";
    case GLFW_KEY_DELETE:
      return "delete";
    case GLFW_KEY_LEFT:
      return "left";
    case GLFW_KEY_RIGHT:
      return "right";
    case GLFW_KEY_UP:
      return "up";
    case GLFW_KEY_DOWN:
      return "down";
    case GLFW_KEY_HOME:
      return "home";
    case GLFW_KEY_END:
      return "end";
    case GLFW_KEY_KP_ADD:
      return "+";
    case GLFW_KEY_KP_SUBTRACT:
      return "-";
    default:
      return {};
  }
}

// The same as the keyboard is labelled, if that is a name of ours.
std::string LabelOf(int key, int scancode) {
  const std::string name = KeyName(key);
  const char* label = name.size() > 1 ? nullptr : glfwGetKeyName(key, scancode);
  return label && label[0] != '\0' && label[1] == '\0' && IsKeyName(label) ? label : name;
}

// The keys that ImGui's text fields listen to, with its names for them.
constexpr std::pair<const char*, ImGuiKey_> kImGuiKeys[] = {{"tab", ImGuiKey_Tab},
                                                            {"left", ImGuiKey_LeftArrow},
                                                            {"right", ImGuiKey_RightArrow},
                                                            {"up", ImGuiKey_UpArrow},
                                                            {"down", ImGuiKey_DownArrow},
                                                            {"home", ImGuiKey_Home},
                                                            {"end", ImGuiKey_End},
                                                            {"delete", ImGuiKey_Delete},
                                                            {"backspace", ImGuiKey_Backspace},
                                                            {"space", ImGuiKey_Space},
                                                            {"enter", ImGuiKey_Enter},
                                                            {"escape", ImGuiKey_Escape},
                                                            {"a", ImGuiKey_A},
                                                            {"c", ImGuiKey_C},
                                                            {"v", ImGuiKey_V},
                                                            {"x", ImGuiKey_X},
                                                            {"y", ImGuiKey_Y},
                                                            {"z", ImGuiKey_Z}};

unsigned FromGlfwModifiers(int mods) {
  return (mods & GLFW_MOD_SHIFT ? kShift : 0U) | (mods & GLFW_MOD_CONTROL ? kCtrl : 0U) |
         (mods & GLFW_MOD_ALT ? kAlt : 0U);
}

class Window final : public ScriptStage {
 public:
  Window(Viewer& viewer, const Script* script, const UserFiles* files, std::optional<double> scale);
  ~Window() override;
  void Run();

  void Input(const InputEvent& event) override { events_.push_back(event); }
  void Resize(int width, int height) override;
  void Screenshot(const std::string& path) override { screenshot_ = path; }

 private:
  void Listen();
  void PressKey(int key, int scancode, int mods);
  void ReleaseKey(int scancode, int mods);
  void TypeCharacter(unsigned text);
  void SetUpImGui(std::optional<double> scale);
  void FeedEvents();
  void CapturePointer();
  void Feed(const InputEvent& event);
  void DrawFrame(double seconds);
  void WriteScreenshot(int width, int height);
  void Remember() const;

  Viewer& viewer_;
  const UserFiles* files_;
  std::optional<ScriptPlayer> player_;
  GLFWwindow* window_ = nullptr;
  GLuint texture_ = 0;
  Panels panels_;
  std::deque<InputEvent> events_;
  std::map<int, std::string> pressed_;  // the names of the keys that are down, by scancode
  struct PressedKey {
    int scancode;
    std::string label;
    unsigned modifiers;
  };
  std::optional<PressedKey> typing_;  // the key that was pressed last, until its character comes
  double x_ = 0, y_ = 0;              // of the pointer, in pixels
  double scale_x_ = 1,
         scale_y_ = 1;  // pixels a unit of the window's coordinates
  bool pressed_in_picture_[3] = {};
  int held_frames_ = 0;    // that keys have waited for a field to open
  bool captured_ = false;  // the pointer, which then is nowhere for ImGui
  std::string screenshot_;
};

Window::Window(Viewer& viewer, const Script* script, const UserFiles* files, std::optional<double> scale)
    : viewer_(viewer), files_(files) {
  if (script) player_.emplace(*script);
  glfwSetErrorCallback(&KeepError);
  if (!glfwInit())
    throw InputError(
        fmt::format("penumbra: error: there is no display to open a window on ({}); "
                    "`penumbra render` draws without one",
                    LastError()));
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, script ? GLFW_FALSE : GLFW_TRUE);
  int width = kWidth, height = kHeight;
  if (files_) {
    const std::string size = files_->Read("size");
    const std::size_t x = size.find('x');
    if (x != size.npos) {
      try {
        width = static_cast<int>(NumberFrom(size.substr(0, x), 100, 16384));
        height = static_cast<int>(NumberFrom(size.substr(x + 1), 100, 16384));
      } catch (const InputError&) {  // someone wrote something else into it
        width = kWidth;
        height = kHeight;
      }
    }
  }
  window_ = glfwCreateWindow(width, height, "Penumbra", nullptr, nullptr);
  if (!window_) {
    glfwTerminate();
    throw InputError(
        fmt::format("penumbra: error: no window with OpenGL 3.3 can be opened ({})", LastError()));
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(player_ ? 0 : 1);
  SetUpImGui(scale);
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  if (!player_) Listen();
  // A script answers no questions, unless it asks for them.
  if (player_) viewer_.Set("ask-above", "1e9");
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
  glDeleteTextures(1, &texture_);
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::SetUpImGui(std::optional<double> scale) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // kept by us, where users' files belong
  int number = 0;
  for (const auto& [name, key] : kImGuiKeys) {
    static_cast<void>(name);
    io.KeyMap[key] = number++;
  }
  ImGui::StyleColorsDark();
  ImGui::GetStyle().WindowRounding = 4;
  float sx = 1, sy = 1;
  glfwGetWindowContentScale(window_, &sx, &sy);
  const float larger = scale ? static_cast<float>(*scale) : player_ ? 1.0F : std::max(sx, 1.0F);
  // Letters are drawn at their size, not stretched to it.
  ImFontConfig font;
  font.SizePixels = std::round(kPlainFontSize * larger);
  io.Fonts->AddFontDefault(&font);
  ImGui::GetStyle().ScaleAllSizes(larger);
  if (files_) {
    const std::string layout = files_->Read("layout.ini");
    ImGui::LoadIniSettingsFromMemory(layout.data(), layout.size());
    files_->OpenPanels(&viewer_);
  }
  ImGui_ImplOpenGL3_Init("#version 330");
}

// Everything that GLFW hears becomes an event, to be taken up with the next frame.
void Window::Listen() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    auto* window = static_cast<Window*>(glfwGetWindowUserPointer(w));
    window->typing_.reset();
    if (action == GLFW_PRESS) window->PressKey(key, scancode, mods);
    if (action == GLFW_RELEASE) window->ReleaseKey(scancode, mods);
    // Text fields repeat by themselves.
  });
  glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned text) {
    static_cast<Window*>(glfwGetWindowUserPointer(w))->TypeCharacter(text);
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
    auto* window = static_cast<Window*>(glfwGetWindowUserPointer(w));
    InputEvent event;
    event.kind = InputEvent::Kind::kMove;
    event.x = x * window->scale_x_;
    event.y = y * window->scale_y_;
    window->Input(event);
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    auto* window = static_cast<Window*>(glfwGetWindowUserPointer(w));
    double x = 0, y = 0;
    glfwGetCursorPos(w, &x, &y);
    InputEvent event;
    event.kind = action == GLFW_PRESS ? InputEvent::Kind::kButtonDown : InputEvent::Kind::kButtonUp;
    event.button = static_cast<MouseButton>(button);
    event.modifiers = FromGlfwModifiers(mods);
    event.x = x * window->scale_x_;
    event.y = y * window->scale_y_;
    window->Input(event);
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double notches) {
    InputEvent event;
    event.kind = InputEvent::Kind::kScroll;
    event.scroll = notches;
    static_cast<Window*>(glfwGetWindowUserPointer(w))->Input(event);
  });
}

void Window::PressKey(int key, int scancode, int mods) {
  typing_ = PressedKey{scancode, LabelOf(key, scancode), FromGlfwModifiers(mods)};
  InputEvent event;
  event.kind = InputEvent::Kind::kKeyDown;
  event.key = pressed_[scancode] = typing_->label;
  event.modifiers = typing_->modifiers;
  Input(event);
}

// By the name that it was pressed with: shift may have been let go since.
void Window::ReleaseKey(int scancode, int mods) {
  InputEvent event;
  event.kind = InputEvent::Kind::kKeyUp;
  event.key = std::exchange(pressed_[scancode], {});
  event.modifiers = FromGlfwModifiers(mods);
  Input(event);
}

// A character follows the press of its key, and says what the key is called.
void Window::TypeCharacter(unsigned text) {
  if (typing_ && !events_.empty() && events_.back().kind == InputEvent::Kind::kKeyDown) {
    const KeyChord chord = ChordOf(typing_->label, typing_->modifiers, text);
    events_.back().key = pressed_[typing_->scancode] = chord.key;
    events_.back().modifiers = chord.modifiers;
  }
  typing_.reset();
  InputEvent event;
  event.kind = InputEvent::Kind::kText;
  event.text = text;
  Input(event);
}

void Window::Resize(int width, int height) {
  glfwSetWindowSize(window_, width, height);
  // A window manager may take its time, or have another opinion.
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    glfwPollEvents();
    int w = 0, h = 0;
    glfwGetWindowSize(window_, &w, &h);
    if (w == width && h == height) return;
    glfwWaitEventsTimeout(0.01);
  }
}

// To ImGui, and to the viewer unless a panel wants it.
void Window::Feed(const InputEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  io.KeyShift = (event.modifiers & kShift) != 0;
  io.KeyCtrl = (event.modifiers & kCtrl) != 0;
  io.KeyAlt = (event.modifiers & kAlt) != 0;
  const auto button = static_cast<std::size_t>(event.button);
  switch (event.kind) {
    case InputEvent::Kind::kKeyDown:
    case InputEvent::Kind::kKeyUp: {
      const bool down = event.kind == InputEvent::Kind::kKeyDown;
      int number = 0;
      for (const auto& [name, key] : kImGuiKeys) {
        if (event.key == name) io.KeysDown[number] = down;
        ++number;
      }
      if (!down || !panels_.WantsKeys(viewer_)) viewer_.Handle(event);
      return;
    }
    case InputEvent::Kind::kText:
      io.AddInputCharacter(event.text);
      return;
    case InputEvent::Kind::kScroll:
      io.MouseWheel += static_cast<float>(event.scroll);
      if (!io.WantCaptureMouse) viewer_.Handle(event);
      return;
    case InputEvent::Kind::kMove:
    case InputEvent::Kind::kButtonDown:
    case InputEvent::Kind::kButtonUp:
      break;
  }
  x_ = event.x;
  y_ = event.y;
  if (!captured_) io.MousePos = ImVec2(static_cast<float>(x_ / scale_x_), static_cast<float>(y_ / scale_y_));
  if (event.kind == InputEvent::Kind::kMove) {
    viewer_.Handle(event);
    return;
  }
  const bool down = event.kind == InputEvent::Kind::kButtonDown;
  io.MouseDown[button] = down;
  if (down) pressed_in_picture_[button] = !io.WantCaptureMouse;
  if (pressed_in_picture_[button]) viewer_.Handle(event);
  if (!down) pressed_in_picture_[button] = false;
}

// ImGui looks at the state of keys and buttons once a frame: of what goes down and up again, or moves before
// a press, the second part waits for the next.
void Window::FeedEvents() {
  bool moved = false, changed = false;
  while (!events_.empty()) {
    const InputEvent event = events_.front();
    const bool move = event.kind == InputEvent::Kind::kMove;
    const bool text = event.kind == InputEvent::Kind::kText;
    const bool key = text || event.kind == InputEvent::Kind::kKeyDown;
    // The field of a dialog that opens gets the keys with one of the next frames.
    if (!panels_.IsOpening(viewer_)) held_frames_ = 0;
    if (key && panels_.IsOpening(viewer_) && ++held_frames_ < kMostHeldFrames) return;
    if ((changed && !text) || (moved && !move)) return;
    events_.pop_front();
    try {
      Feed(event);
    } catch (const InputError& error) {
      viewer_.Complain(error.what());
    }
    moved |= move;
    changed |= !move && !text;
  }
}

// While the mouse looks around, the pointer goes on for ever and is not seen.
void Window::CapturePointer() {
  if (captured_ == viewer_.Looking()) return;
  captured_ = !captured_;
  // A script leaves the user his pointer.
  if (!player_) glfwSetInputMode(window_, GLFW_CURSOR, captured_ ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  if (captured_) ImGui::GetIO().MousePos = ImVec2(-FLT_MAX, -FLT_MAX);
}

void Window::DrawFrame(double seconds) {
  int width = 0, height = 0, w = 0, h = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  glfwGetWindowSize(window_, &w, &h);
  if (width < 1 || height < 1 || w < 1 || h < 1) return;  // minimised
  scale_x_ = static_cast<double>(width) / w;
  scale_y_ = static_cast<double>(height) / h;
  FeedEvents();
  CapturePointer();

  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(w), static_cast<float>(h));
  io.DisplayFramebufferScale = ImVec2(static_cast<float>(scale_x_), static_cast<float>(scale_y_));
  io.DeltaTime = static_cast<float>(std::max(seconds, 1e-4));
  // The viewer may draw with a context of its own, and a thread has one at a time.
  glfwMakeContextCurrent(nullptr);
  const Srgb8Image& picture = viewer_.Frame(width, height, seconds);
  glfwMakeContextCurrent(window_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, width, height, 0, GL_RGB, GL_UNSIGNED_BYTE, picture.pixels.data());

  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  // A texture's name travels as a pointer: ImGui's way.
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  ImGui::GetBackgroundDrawList()->AddImage(
      reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture_)), ImVec2(0, 0), io.DisplaySize);
  panels_.Draw(viewer_);
  ImGui::Render();
  glViewport(0, 0, width, height);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  if (!screenshot_.empty()) WriteScreenshot(width, height);
  glfwSwapBuffers(window_);
}

void Window::WriteScreenshot(int width, int height) {
  Srgb8Image image;
  image.Resize(width, height);
  std::vector<std::uint8_t> rows(image.pixels.size());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
  const std::ptrdiff_t row = 3 * static_cast<std::ptrdiff_t>(width);
  for (int y = 0; y < height; ++y)  // OpenGL's rows run from the bottom
    std::copy_n(rows.begin() + (height - 1 - y) * row, row, image.pixels.begin() + y * row);
  const std::string path = std::exchange(screenshot_, {});
  WritePng(path, image);
}

void Window::Remember() const {
  if (!files_) return;
  int w = 0, h = 0;
  glfwGetWindowSize(window_, &w, &h);
  files_->Write("size", fmt::format("{}x{}", w, h));
  files_->Write("layout.ini", ImGui::SaveIniSettingsToMemory());
  files_->KeepPanels(viewer_);
}

void Window::Run() {
  auto before = std::chrono::steady_clock::now();
  while (!viewer_.panels().quit) {
    if (glfwWindowShouldClose(window_)) {
      glfwSetWindowShouldClose(window_, GLFW_FALSE);
      viewer_.RunMenu("File/Quit");  // which may ask
      continue;
    }
    if (!player_ && events_.empty() && viewer_.Idle())
      glfwWaitEventsTimeout(kRestSeconds);
    else
      glfwPollEvents();
    const auto now = std::chrono::steady_clock::now();
    const double real = std::chrono::duration<double>(now - before).count();
    before = now;
    // Steps follow one another only once the last is done with.
    if (player_ && events_.empty() && screenshot_.empty() && !player_->Advance(viewer_, *this, real)) break;
    DrawFrame(player_ ? kScriptFrame : std::min(real, 0.25));
  }
  Remember();
}

}  // namespace

void RunWindow(Viewer& viewer, const Script* script, const UserFiles* files, std::optional<double> scale) {
  Window(viewer, script, files, scale).Run();
}

}  // namespace penumbra::viewer
