// display/opengl_context.h
//
// A context of OpenGL without a window, by EGL, which is looked for when the first is made: a machine without
// it lacks nothing but this.

#pragma once

#include <memory>
#include <type_traits>

namespace penumbra {

class OpenGlContext {
 public:
  // A context of OpenGL 3.3, core profile. Throws InputError, one line, if there is none.
  OpenGlContext();
  // Everything made in it goes with it.
  ~OpenGlContext();
  OpenGlContext(const OpenGlContext&) = delete;
  OpenGlContext& operator=(const OpenGlContext&) = delete;

  // Makes the context current in the calling thread while it lives; none is afterwards.
  class Current {
   public:
    explicit Current(const OpenGlContext& context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

   private:
    const OpenGlContext& context_;
  };

  // OpenGL's function of that name. Throws InputError if there is none.
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
