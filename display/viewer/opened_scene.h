// display/viewer/opened_scene.h
//
// What the window gets from files and writes into them. Whoever opens the window knows how.

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
  // NOLINTNEXTLINE(google-explicit-constructor): a scene is one that nobody has solved yet.
  OpenedScene(std::shared_ptr<const Scene> the_scene) : scene(std::move(the_scene)) {}

  std::shared_ptr<const Scene> scene;
  // Of a solution file; refers to the scene. Null: not solved.
  std::shared_ptr<PipelineState> stored;
  // Of another solution of the same geometry, over whose links the scene is lit. Null: it gets its own.
  std::shared_ptr<const PipelineState> restart;
  PipelineOptions solving;  // of either, as it was solved
};

// What says how a scene is read.
struct ReadingOption {
  std::string name, help;
  bool toggle = false;  // else text
  std::function<std::string()> value;
};

// Each throws InputError, a line that says what is wrong. Those that write do it beside the place, then
// rename.
struct ViewerFiles {
  using WriteSolved = std::function<void(const std::string& path, const Pipeline& pipeline)>;

  // A scene or a solution by its path or name.
  std::function<OpenedScene(const std::string& name)> open;
  // The scene that was opened last, read anew with another value of one of these options.
  std::vector<ReadingOption> reading;
  std::function<OpenedScene(const std::string& option, const std::string& value)> read_with;
  // The pipeline is solved, meshed for interpolants and measured.
  WriteSolved save_solution, save_report;
  // Whether the format that the path's ending names holds the mesh, and not the scene alone.
  std::function<bool(const std::string& path)> exports_mesh;
  // `mesh` is null where the format does without.
  std::function<void(const std::string& path, const Scene& scene, const IrradianceMesh* mesh,
                     const Camera& camera)>
      export_file;
};

}  // namespace penumbra::viewer
