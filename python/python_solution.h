// python/python_solution.h
//
// The Python classes Solution and Solver.

#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/load_scene.h"
#include "apps/points_csv.h"
#include "apps/probe.h"
#include "mesh/pipeline/pipeline.h"
#include "python/python_scene.h"
#include "solver/base/progress.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

// The method by which irradiance at points is measured, and the choice whether direct light and gradients are
// measured.
struct ProbeRequest {
  std::string method = "auto";  // an occlusion method in OcclusionMethods(), or "auto"
  bool parts = false;           // if true, direct light and gradients are measured in addition to irradiance
};

// The Python class Solution: a solved scene. Several threads may use one PythonSolution at the same time. No
// function of PythonSolution uses Python objects.
class PythonSolution {
 public:
  // Takes over a pipeline that is solved and has a mesh. `options` has the format of OptionsUsed().
  // `measured` is true if the error of the solution has been measured.
  PythonSolution(PythonScene scene, std::unique_ptr<Pipeline> pipeline, nlohmann::ordered_json options,
                 bool measured);
  // Reads a solution from a solution file. Throws InputError if the file is not a solution.
  static std::shared_ptr<PythonSolution> Load(const std::string& path);

  const PythonScene& scene() const { return scene_; }
  const Pipeline& pipeline() const { return *pipeline_; }
  const nlohmann::ordered_json& options() const { return options_; }

  // Measures irradiance at points, as the command `probe` does. The result is unspecified if the context is
  // cancelled.
  std::vector<Measurement> Probe(const std::vector<ProbePoint>& points, const ProbeRequest& request,
                                 const ExecutionContext& context) const;

  // A mutex that callers of Measure(), FileBytes() and MeshOfKind() must hold, because these functions may
  // change the measured errors and add meshes.
  std::mutex& Busy() const { return busy_; }
  // Measures the error of the solution, unless the error has already been measured.
  void Measure(const ExecutionContext& context);
  // Returns the bytes of a solution file that holds this solution. REQUIRES: Measure() was not cancelled.
  std::string FileBytes() const;
  // Returns a mesh of the kind `kind` for the light of the solution; each mesh is made at the first call.
  // Returns null if the context is cancelled.
  const IrradianceMesh* MeshOfKind(MeshKind kind, const ExecutionContext& context) const;

 private:
  // If `parts` is true, the Prober also measures direct light and gradients.
  Prober MakeProber(const PointIrradiance& irradiance, bool parts) const {
    return Prober(*scene_.scene, irradiance, pipeline_.get(), parts);
  }

  const PythonScene scene_;
  std::unique_ptr<Pipeline> pipeline_;
  nlohmann::ordered_json options_;
  bool measured_ = false;
  mutable std::mutex busy_, probing_;
  // The objects that measure irradiance with the default occlusion method; the first call of Probe() makes
  // them.
  mutable std::unique_ptr<const PointIrradiance> irradiance_;
  mutable std::unique_ptr<const Prober> prober_;
  mutable std::map<MeshKind, IrradianceMesh> other_meshes_;
};

// The Python class Solver, by which a scene is solved step by step.
struct PythonSolver {
  PythonScene scene;
  std::unique_ptr<Pipeline> pipeline;  // pipeline of the solve; null after the solve is finished
  nlohmann::ordered_json options;
  bool linked = false;
  std::mutex busy;
};

}  // namespace penumbra
