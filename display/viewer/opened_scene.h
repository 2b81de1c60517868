// display/viewer/opened_scene.h
//
// The functions by which the viewer's window opens and saves files. The program that opens the window
// provides the functions of ViewerFiles.

#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "display/viewer/light_change.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"

namespace penumbra::viewer {

struct OpenedScene {
  OpenedScene() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a scene converts to an OpenedScene without a solution.
  OpenedScene(std::shared_ptr<const Scene> the_scene) : scene(std::move(the_scene)) {}

  std::shared_ptr<const Scene> scene;
  // The solver's state from a solution file, which refers to `scene`; null if no solution file was opened.
  std::shared_ptr<PipelineState> stored;
  // If not null, `restart` is the state of another solution of the same geometry, whose links between
  // elements are used to solve `scene`. If `restart` is null, the solver makes new links.
  std::shared_ptr<const PipelineState> restart;
  PipelineOptions solving;  // the options of `stored` or `restart`
};

// An option that determines how a scene file is read.
struct ReadingOption {
  std::string name, help;
  bool toggle = false;  // true if the option's value is on or off; false if the value is any text
  std::function<std::string()> value;
};

// The file functions of the viewer. Each function of ViewerFiles throws InputError with one line that
// describes the fault. The functions of ViewerFiles that write a file write a temporary file in the same
// folder, and then rename the temporary file.
struct ViewerFiles {
  using WriteSolved = std::function<void(const std::string& path, const Pipeline& pipeline)>;

  // Opens a scene or a solution by its path or name.
  std::function<OpenedScene(const std::string& name)> open;
  // `reading` lists the options for reading scene files. The function read_with() reads the last opened scene
  // again, with another value of one option.
  std::vector<ReadingOption> reading;
  std::function<OpenedScene(const std::string& option, const std::string& value)> read_with;
  // Functions that write a solution or a report. REQUIRES: the pipeline is solved and measured, and has a
  // mesh of kind kInterpolant.
  WriteSolved save_solution, save_report;
  // Says by which change of the opened scene's light the pipelines differ that are written from now on.
  std::function<void(const LightChange&)> lit_as = {};
  // Returns a function that brings back how the scene is read now, for undo: which scene, and its options.
  std::function<std::function<void()>()> keep_reading = {};
  // True if the file format that belongs to the path's ending stores the mesh, not only the scene.
  std::function<bool(const std::string& path)> exports_mesh;
  // The function export_file() writes a scene, or a mesh with its light, to a file. The argument `mesh` is
  // null if the file format does not store the mesh.
  std::function<void(const std::string& path, const Scene& scene, const IrradianceMesh* mesh,
                     const Camera& camera)>
      export_file;
};

}  // namespace penumbra::viewer
