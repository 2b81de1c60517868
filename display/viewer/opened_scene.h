// display/viewer/opened_scene.h
//
// The functions by which the window opens and saves files. The program that opens the window provides the
// functions of ViewerFiles.

#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"

namespace penumbra::viewer {

struct OpenedScene {
  OpenedScene() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a scene converts to an OpenedScene without a solution.
  OpenedScene(std::shared_ptr<const Scene> the_scene) : scene(std::move(the_scene)) {}

  std::shared_ptr<const Scene> scene;
  // The state from a solution file, which refers to `scene`; null if no solution was opened.
  std::shared_ptr<PipelineState> stored;
  // If not null, the state of another solution of the same geometry, whose links are used to solve this
  // scene. If null, new links are made.
  std::shared_ptr<const PipelineState> restart;
  PipelineOptions solving;  // the options of `stored` or `restart`
};

// An option that determines how a scene is read.
struct ReadingOption {
  std::string name, help;
  bool toggle = false;  // on or off; otherwise text
  std::function<std::string()> value;
};

// Each function throws InputError with one line that describes the fault. Functions that write use a
// temporary file beside the target, then rename it.
struct ViewerFiles {
  using WriteSolved = std::function<void(const std::string& path, const Pipeline& pipeline)>;

  // Opens a scene or a solution by its path or name.
  std::function<OpenedScene(const std::string& name)> open;
  // The function read_with() reads the last opened scene again, with another value of one of the options
  // `reading`.
  std::vector<ReadingOption> reading;
  std::function<OpenedScene(const std::string& option, const std::string& value)> read_with;
  // REQUIRES: the pipeline is solved, measured, and has a mesh of kind kInterpolant.
  WriteSolved save_solution, save_report;
  // True if the file format that belongs to the path's ending stores the mesh, not only the scene.
  std::function<bool(const std::string& path)> exports_mesh;
  // `mesh` is null if the format does not store the mesh.
  std::function<void(const std::string& path, const Scene& scene, const IrradianceMesh* mesh,
                     const Camera& camera)>
      export_file;
};

}  // namespace penumbra::viewer
