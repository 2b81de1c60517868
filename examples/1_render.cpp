// Example 1: solve a scene and render a picture of it.
//
//   example_1_render [SCENE [PICTURE.png]]

#include <fmt/format.h>

#include <string>

#include "display/camera.h"
#include "display/png_image.h"
#include "display/tone_mapping.h"
#include "display/two_pass_display.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/check.h"
#include "solver/scene/named_scene.h"

using namespace penumbra;

int main(int argc, char** argv) try {
  // 1. Read a scene: an OBJ file, or one of the built-in scenes by its name.
  const Scene scene = ReadNamedScene(argc > 1 ? argv[1] : "floating-cube", SceneOptions());
  fmt::print("{}: {} patches\n", scene.name, scene.patches.size());

  // 2. Say how exact the light shall be. Of 100 points on the surfaces, 99 may be wrong by at most this
  //    fraction of their irradiance. All other options follow from it.
  PipelineOptions options;
  options.error = 0.05;

  // 3. Solve for the light. The context could report progress or cancel the work; here it does neither.
  const ExecutionContext context;
  Pipeline pipeline(scene, options);
  pipeline.Solve(context);

  // 4. Make the mesh that is shown: triangles cut along the edges of shadows, with a quadratic function for
  //    the irradiance over each of them. Before that, a first mesh refines the light.
  pipeline.RefineLight(context);
  pipeline.BuildMesh(MeshKind::kInterpolant, context);
  fmt::print("{} links, {} triangles\n", pipeline.report().counts.links, pipeline.mesh().triangles.size());

  // 5. Choose a camera: one that the scene brings along, or one that sees all of the scene.
  const Camera camera = scene.cameras.empty() ? FrameScene(scene) : scene.cameras.front();

  // 6. Draw the picture. It holds radiosity in W/m^2.
  TwoPassDisplay display(scene, pipeline.mesh());
  const RenderedFrame& frame = display.Render(camera, 480, 360);

  // 7. Choose an exposure, turn radiosity into the 8-bit values of a screen, and write the file.
  ToneMapping tone;
  tone.exposure = MeterExposure(frame.linear, frame.kind);
  const std::string path = argc > 2 ? argv[2] : "render.png";
  WritePng(path, display.ToneMap(tone).screen);
  fmt::print("wrote {}\n", path);
  return 0;
} catch (const InputError& error) {
  // What a user gave cannot be used: a file that is missing, say. The message says how to mend it.
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
