#include "display/opengl_passes.h"

#define GL_GLEXT_PROTOTYPES 1  // for their types; none is linked
#include <GL/glcorearb.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "display/glm_conversion.h"
#include "display/opengl_context.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

constexpr std::size_t kTrianglesPerTask = 2048;
constexpr int kTexels = 256;  // a side of the thesis's texture

// How near to the eye a triangle is cut off, in units of the mesh's extent. Depths are floats of 1 / z, so
// that it costs no precision.
constexpr double kNear = 1e-7;

constexpr const char* kVertexShader = R"(#version 330 core
layout(location = 0) in vec4 position;
layout(location = 1) in vec3 plane0;
layout(location = 2) in vec3 plane1;
layout(location = 3) in vec3 plane2;
layout(location = 4) in vec2 origin;
layout(location = 5) in uint triangle;
flat out vec3 planes[3];
flat out vec2 at;
flat out uint id;
void main() {
  planes[0] = plane0;
  planes[1] = plane1;
  planes[2] = plane2;
  at = origin;
  id = triangle;
  gl_Position = position;
})";

constexpr const char* kIdShader = R"(#version 330 core
flat in uint id;
out vec4 colour;
void main() {
  uint n = id + 1u;
  colour = vec4(n & 255u, (n >> 8) & 255u, (n >> 16) & 255u, n >> 24) / 255.0;
})";

// What follows in both: the coordinates where the pixel's centre is. Interpolated ones would be those of
// corners that were rounded to a part of a pixel: in a triangle of ten pixels, wrong by 1e-4.
#define PENUMBRA_COORDINATES                                                              \
  "#version 330 core\n"                                                                   \
  "flat in vec3 planes[3];\n"                                                             \
  "flat in vec2 at;\n"                                                                    \
  "out vec2 coordinates;\n"                                                               \
  "vec2 Coordinates() {\n"                                                                \
  "  vec3 p = vec3(gl_FragCoord.xy - at, 1.0);\n"                                         \
  "  vec3 b = max(vec3(dot(planes[0], p), dot(planes[1], p), dot(planes[2], p)), 0.0);\n" \
  "  return b.yz / max(b.x + b.y + b.z, 1e-37);\n"                                        \
  "}\n"

constexpr const char* kFloatShader = PENUMBRA_COORDINATES "void main() { coordinates = Coordinates(); }";

constexpr const char* kTextureShader = PENUMBRA_COORDINATES
    "uniform sampler2D texels;\n"
    "void main() { coordinates = texture(texels, Coordinates()).rg; }";

// clang-format off
#define PENUMBRA_GL_FUNCTIONS(F) \
  F(AttachShader) F(BindBuffer) F(BindFramebuffer) F(BindRenderbuffer) F(BindTexture) \
  F(BindVertexArray) F(BufferData) F(CheckFramebufferStatus) F(Clear) F(ClearColor) F(ClearDepth) \
  F(ClipControl) F(CompileShader) F(CreateProgram) F(CreateShader) F(CullFace) F(DepthFunc) \
  F(Disable) F(DrawArrays) F(Enable) F(EnableVertexAttribArray) F(FramebufferRenderbuffer) \
  F(FrontFace) F(GenBuffers) F(GenFramebuffers) F(GenRenderbuffers) F(GenTextures) \
  F(GenVertexArrays) F(GetError) F(GetIntegerv) F(GetProgramiv) F(LinkProgram) F(PixelStorei) \
  F(ReadPixels) F(RenderbufferStorage) F(ShaderSource) F(TexImage2D) F(TexParameteri) F(UseProgram) \
  F(VertexAttribIPointer) F(VertexAttribPointer) F(Viewport)
// clang-format on

struct GlFunctions {
#define PENUMBRA_GL_DECLARE(name) decltype(&gl##name) name = nullptr;
  PENUMBRA_GL_FUNCTIONS(PENUMBRA_GL_DECLARE)
#undef PENUMBRA_GL_DECLARE

  explicit GlFunctions(const OpenGlContext& context) {
#define PENUMBRA_GL_LOAD(name) context.Load("gl" #name, &name);
    PENUMBRA_GL_FUNCTIONS(PENUMBRA_GL_LOAD)
#undef PENUMBRA_GL_LOAD
  }
};

// A corner as the graphics system gets it, with what it has to know of its triangle.
struct DrawnVertex {
  glm::vec4 position;
  std::array<glm::vec3, 3> planes;  // of the three coordinates, in pixels from `origin`; proportional to them
  glm::vec2 origin;                 // the centre of a pixel
  std::uint32_t triangle;
};

// The plane through the eye, b and a, as a function of picture coordinates (Olano and Greer 1997).
glm::dvec3 EdgePlane(const glm::dvec3& a, const glm::dvec3& b) { return glm::cross(b, a); }

// Fills `planes` and `origin` from the corners in homogeneous picture coordinates.
void SetPlanes(const std::array<glm::dvec3, 3>& triangle, int width, int height, DrawnVertex* vertex) {
  // Near the triangle where all of it is before the eye: floats then lose nothing on the way to it.
  glm::dvec3 origin(width / 2 + 0.5, height / 2 + 0.5, 1);
  if (triangle[0].z > 0 && triangle[1].z > 0 && triangle[2].z > 0) {
    glm::dvec3 centre(0.0);
    for (const glm::dvec3& v : triangle) centre += v / v.z / 3.0;
    origin.x = std::floor(std::clamp(centre.x, 0.0, width - 1.0)) + 0.5;
    origin.y = std::floor(std::clamp(centre.y, 0.0, height - 1.0)) + 0.5;
  }
  std::array<glm::dvec3, 3> planes;
  double largest = std::numeric_limits<double>::min();
  for (std::size_t k = 0; k < 3; ++k) {
    planes[k] = EdgePlane(triangle[(k + 1) % 3], triangle[(k + 2) % 3]);
    planes[k].z = glm::dot(planes[k], origin);
    largest = std::max({largest, std::abs(planes[k].x), std::abs(planes[k].y), std::abs(planes[k].z)});
  }
  for (std::size_t k = 0; k < 3; ++k) vertex->planes[k] = ToFloats(planes[k] / largest);
  vertex->origin = glm::vec2(ToFloats(origin));
}

class OpenGl : public Passes {
 public:
  OpenGl(const IrradianceMesh& mesh, OpenGlCoordinates coordinates);

  void DrawTriangleIds(const PixelRays& rays, int width, int height, std::span<std::uint32_t> ids) override;
  void DrawBarycentrics(std::span<const std::uint32_t> ids, std::span<float> s, std::span<float> t) override;

 private:
  using Current = OpenGlContext::Current;

  GLuint MakeProgram(const char* fragment_shader);
  void MakeTexture();
  void MakeVertexArray();
  // Frame buffers of that size: ids, coordinates, depths.
  void Resize(int width, int height);
  void Project(const PixelRays& rays);
  void Draw(GLuint frame_buffer, GLuint program);

  std::vector<std::array<glm::dvec3, 3>> triangles_;
  double near_ = 0;  // [m]
  OpenGlContext context_;
  GlFunctions gl_{context_};
  GLuint id_program_ = 0, coordinate_program_ = 0;
  std::array<GLuint, 2> frame_buffers_ = {};   // ids, coordinates
  std::array<GLuint, 3> render_buffers_ = {};  // ids, coordinates, depths
  int width_ = 0, height_ = 0;
  std::vector<DrawnVertex> vertices_;
  std::vector<float> read_;
};

OpenGl::OpenGl(const IrradianceMesh& mesh, OpenGlCoordinates coordinates) {
  const Current current(context_);
  glm::dvec3 low(0.0), high(0.0);
  if (!mesh.positions.empty()) low = high = ToGlm(mesh.positions.front());
  for (const Vec3& p : mesh.positions) {
    low = glm::min(low, ToGlm(p));
    high = glm::max(high, ToGlm(p));
  }
  near_ = std::max(kNear * glm::length(high - low), static_cast<double>(std::numeric_limits<float>::min()));
  for (const IrradianceMesh::Triangle& triangle : mesh.triangles)
    triangles_.push_back({ToGlm(mesh.positions[triangle.vertex[0]]),
                          ToGlm(mesh.positions[triangle.vertex[1]]),
                          ToGlm(mesh.positions[triangle.vertex[2]])});
  vertices_.resize(3 * triangles_.size());

  id_program_ = MakeProgram(kIdShader);
  coordinate_program_ = MakeProgram(coordinates == OpenGlCoordinates::kFloat ? kFloatShader : kTextureShader);
  if (coordinates == OpenGlCoordinates::kTexture) MakeTexture();
  MakeVertexArray();
  gl_.GenFramebuffers(2, frame_buffers_.data());
  gl_.GenRenderbuffers(3, render_buffers_.data());

  for (const GLenum unwanted : {GL_DITHER, GL_MULTISAMPLE, GL_FRAMEBUFFER_SRGB, GL_BLEND})
    gl_.Disable(unwanted);
  // Depth is near / z, between 1 at the near plane and 0 far away.
  gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_GREATER);
  gl_.ClearDepth(0);
  gl_.ClearColor(0, 0, 0, 0);
  // The first row drawn is the picture's upper one: fronts run clockwise.
  gl_.Enable(GL_CULL_FACE);
  gl_.CullFace(GL_BACK);
  gl_.FrontFace(GL_CW);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  PENUMBRA_CHECK(gl_.GetError() == GL_NO_ERROR);
}

void OpenGl::MakeVertexArray() {
  GLuint array = 0, buffer = 0;
  gl_.GenVertexArrays(1, &array);
  gl_.BindVertexArray(array);
  gl_.GenBuffers(1, &buffer);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer);
  // A place in the buffer travels as a pointer: OpenGL's way.
  const auto at = [](std::size_t offset) {
    return reinterpret_cast<const void*>(offset);  // NOLINT(performance-no-int-to-ptr)
  };
  constexpr GLsizei kStride = sizeof(DrawnVertex);
  for (GLuint attribute = 0; attribute < 6; ++attribute) gl_.EnableVertexAttribArray(attribute);
  gl_.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, kStride, at(offsetof(DrawnVertex, position)));
  for (GLuint k = 0; k < 3; ++k)
    gl_.VertexAttribPointer(1 + k, 3, GL_FLOAT, GL_FALSE, kStride,
                            at(offsetof(DrawnVertex, planes) + k * sizeof(glm::vec3)));
  gl_.VertexAttribPointer(4, 2, GL_FLOAT, GL_FALSE, kStride, at(offsetof(DrawnVertex, origin)));
  gl_.VertexAttribIPointer(5, 1, GL_UNSIGNED_INT, kStride, at(offsetof(DrawnVertex, triangle)));
}

GLuint OpenGl::MakeProgram(const char* fragment_shader) {
  const GLuint program = gl_.CreateProgram();
  for (const auto& [kind, source] :
       {std::pair{GL_VERTEX_SHADER, kVertexShader}, {GL_FRAGMENT_SHADER, fragment_shader}}) {
    const GLuint shader = gl_.CreateShader(static_cast<GLenum>(kind));
    gl_.ShaderSource(shader, 1, &source, nullptr);
    gl_.CompileShader(shader);
    gl_.AttachShader(program, shader);
  }
  gl_.LinkProgram(program);
  GLint linked = 0;
  gl_.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked)
    throw InputError(
        "penumbra: error: OpenGL: this system cannot compile our shaders; draw with --backend software");
  return program;
}

void OpenGl::MakeTexture() {
  std::vector<std::uint8_t> texels;
  for (int t = 0; t < kTexels; ++t)
    for (int s = 0; s < kTexels; ++s)
      for (const int value : {s, t}) texels.push_back(static_cast<std::uint8_t>(value));
  GLuint texture = 0;
  gl_.GenTextures(1, &texture);
  gl_.BindTexture(GL_TEXTURE_2D, texture);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RG8, kTexels, kTexels, 0, GL_RG, GL_UNSIGNED_BYTE, texels.data());
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl_.TexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl_.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
}

void OpenGl::Resize(int width, int height) {
  if (width == width_ && height == height_) return;
  GLint largest = 0;
  gl_.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  if (width > largest || height > largest)
    throw InputError(
        fmt::format("penumbra: error: OpenGL: {} x {} samples are more than this system draws, {} a side; "
                    "choose a smaller --size, "
                    "--supersampling 1, or --backend software",
                    width, height, largest));
  constexpr std::array<GLenum, 3> kFormats = {GL_RGBA8, GL_RG32F, GL_DEPTH_COMPONENT32F};
  for (std::size_t i = 0; i < kFormats.size(); ++i) {
    gl_.BindRenderbuffer(GL_RENDERBUFFER, render_buffers_[i]);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, kFormats[i], width, height);
  }
  for (std::size_t i = 0; i < frame_buffers_.size(); ++i) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_buffers_[i]);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, render_buffers_[i]);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, render_buffers_[2]);
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw InputError(
          "penumbra: error: OpenGL: this system cannot draw floats; draw with --backend software");
  }
  gl_.Viewport(0, 0, width, height);
  width_ = width;
  height_ = height;
}

// In binary64 from the eye on, so that a scene far from the origin loses nothing.
void OpenGl::Project(const PixelRays& rays) {
  const Projection to_picture = MakeProjection(rays);
  const double across = 2.0 / width_, down = 2.0 / height_;
  ParallelFor(triangles_.size(), kTrianglesPerTask, [&](std::size_t i) {
    std::array<glm::dvec3, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = to_picture(triangles_[i][k] - rays.eye);
    DrawnVertex vertex{};
    SetPlanes(triangle, width_, height_, &vertex);
    vertex.triangle = static_cast<std::uint32_t>(i);
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3& p = triangle[k];
      vertex.position = ToFloats(glm::dvec4(across * p.x - p.z, down * p.y - p.z, near_, p.z));
      vertices_[3 * i + k] = vertex;
    }
  });
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices_.size() * sizeof(DrawnVertex)),
                 vertices_.data(), GL_STREAM_DRAW);
}

void OpenGl::Draw(GLuint frame_buffer, GLuint program) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_buffer);
  gl_.UseProgram(program);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices_.size()));
}

void OpenGl::DrawTriangleIds(const PixelRays& rays, int width, int height, std::span<std::uint32_t> ids) {
  PENUMBRA_CHECK(ids.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const Current current(context_);
  Resize(width, height);
  Project(rays);
  Draw(frame_buffers_[0], id_program_);
  gl_.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, ids.data());
  for (std::uint32_t& id : ids) --id;  // 0 becomes kNoTriangle
  PENUMBRA_CHECK(gl_.GetError() == GL_NO_ERROR);
}

void OpenGl::DrawBarycentrics(std::span<const std::uint32_t> ids, std::span<float> s, std::span<float> t) {
  PENUMBRA_CHECK(ids.size() == static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  PENUMBRA_CHECK(s.size() == ids.size() && t.size() == ids.size());
  const Current current(context_);
  Draw(frame_buffers_[1], coordinate_program_);
  read_.resize(2 * ids.size());
  gl_.ReadPixels(0, 0, width_, height_, GL_RG, GL_FLOAT, read_.data());
  PENUMBRA_CHECK(gl_.GetError() == GL_NO_ERROR);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] == kNoTriangle) continue;
    s[i] = std::clamp(read_[2 * i], 0.0f, 1.0f);
    t[i] = std::clamp(read_[2 * i + 1], 0.0f, 1 - s[i]);
  }
}

}  // namespace

std::unique_ptr<Passes> OpenGlPasses(const IrradianceMesh& mesh, OpenGlCoordinates coordinates) {
  return std::make_unique<OpenGl>(mesh, coordinates);
}

}  // namespace penumbra
