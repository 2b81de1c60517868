// display/opengl_context.h
//
// An OpenGL context without a window, made with EGL. The library EGL is loaded when the first OpenGL context
// is made, so that the program also runs on machines without EGL.

#pragma once

#include <memory>
#include <type_traits>

namespace penumbra {

class OpenGlContext {
 public:
  // Makes an OpenGL 3.3 context, core profile. Throws InputError if the system cannot provide an OpenGL 3.3
  // context.
  OpenGlContext();
  // Destroys the OpenGL context and all OpenGL objects in the context.
  ~OpenGlContext();
  OpenGlContext(const OpenGlContext&) = delete;
  OpenGlContext& operator=(const OpenGlContext&) = delete;

  // A Current object makes the OpenGL context current in the calling thread. When the Current object is
  // destroyed, no OpenGL context is current any more.
  class Current {
   public:
    explicit Current(const OpenGlContext& context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

   private:
    const OpenGlContext& context_;
  };

  // Sets `function` to the OpenGL function called `name`. Throws InputError if OpenGL has no function of this
  // name.
  template <class Function>
  void Load(const char* name, Function* function) const {
    static_assert(std::is_pointer_v<Function>);
    *function = reinterpret_cast<Function>(Address(name));
  }

 private:
  using AnyFunction = void (*)();
  AnyFunction Address(const char* name) const;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
