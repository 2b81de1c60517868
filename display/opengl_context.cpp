#include "display/opengl_context.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <string>

#include "solver/base/check.h"

namespace penumbra {
namespace {

[[noreturn]] void NoContext(const std::string& why) {
  throw InputError(
      fmt::format("penumbra: error: OpenGL: {}; install libegl1, libegl-mesa0 and libgl1-mesa-dri, or draw "
                  "with --backend software",
                  why));
}

// What we call of EGL, from the library that is there at run time.
#define PENUMBRA_EGL_FUNCTIONS(F) \
  F(BindAPI)                      \
  F(ChooseConfig)                 \
  F(CreateContext)                \
  F(DestroyContext)               \
  F(GetDisplay)                   \
  F(GetProcAddress)               \
  F(Initialize)                   \
  F(MakeCurrent)

struct Egl {
#define PENUMBRA_EGL_DECLARE(name) decltype(&egl##name) name = nullptr;
  PENUMBRA_EGL_FUNCTIONS(PENUMBRA_EGL_DECLARE)
#undef PENUMBRA_EGL_DECLARE

  Egl() {
    void* library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) NoContext("there is no libEGL.so.1");
#define PENUMBRA_EGL_LOAD(name)                                               \
  name = reinterpret_cast<decltype(&egl##name)>(dlsym(library, "egl" #name)); \
  if (name == nullptr) NoContext("libEGL.so.1 has no egl" #name);
    PENUMBRA_EGL_FUNCTIONS(PENUMBRA_EGL_LOAD)
#undef PENUMBRA_EGL_LOAD
  }
};

// The library stays for good: drivers do not bear being unloaded.
const Egl& TheEgl() {
  static const Egl egl;
  return egl;
}

// Mesa's display without any window system, else the system's default.
EGLDisplay OpenDisplay(const Egl& egl) {
  const auto platform_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl.GetProcAddress("eglGetPlatformDisplayEXT"));
  if (platform_display != nullptr) {
    const EGLDisplay display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display != EGL_NO_DISPLAY && egl.Initialize(display, nullptr, nullptr)) return display;
  }
  const EGLDisplay display = egl.GetDisplay(EGL_DEFAULT_DISPLAY);
  if (display != EGL_NO_DISPLAY && egl.Initialize(display, nullptr, nullptr)) return display;
  NoContext("there is no EGL display to draw on");
}

}  // namespace

// The display stays open: it is the process's, and others may use it.
struct OpenGlContext::Impl {
  const Egl& egl = TheEgl();
  EGLDisplay display = OpenDisplay(egl);
  EGLContext context = EGL_NO_CONTEXT;

  ~Impl() {
    if (context == EGL_NO_CONTEXT) return;
    Release();
    egl.DestroyContext(display, context);
  }
  bool MakeCurrent() const { return egl.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context); }
  void Release() const { egl.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
};

OpenGlContext::OpenGlContext() : impl_(std::make_unique<Impl>()) {
  const EGLint config_wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                  EGL_NONE};
  const EGLint context_wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                   3,
                                   EGL_CONTEXT_MINOR_VERSION,
                                   3,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                   EGL_NONE};
  const Egl& egl = impl_->egl;
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!egl.BindAPI(EGL_OPENGL_API) || !egl.ChooseConfig(impl_->display, config_wanted, &config, 1, &count) ||
      count < 1)
    NoContext("EGL knows no OpenGL here");
  impl_->context = egl.CreateContext(impl_->display, config, EGL_NO_CONTEXT, context_wanted);
  if (impl_->context == EGL_NO_CONTEXT) NoContext("there is no context of OpenGL 3.3");
  if (!impl_->MakeCurrent()) NoContext("the context cannot do without a window");
  impl_->Release();
}

OpenGlContext::~OpenGlContext() = default;

OpenGlContext::AnyFunction OpenGlContext::Address(const char* name) const {
  const AnyFunction address = impl_->egl.GetProcAddress(name);
  if (address == nullptr) NoContext(fmt::format("the context has no {}", name));
  return address;
}

OpenGlContext::Current::Current(const OpenGlContext& context) : context_(context) {
  PENUMBRA_CHECK(context_.impl_->MakeCurrent());
}

OpenGlContext::Current::~Current() { context_.impl_->Release(); }

}  // namespace penumbra
