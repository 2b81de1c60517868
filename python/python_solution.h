// python/python_solution.h
//
// The classes Solution and Solver of Python.

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

// How points are measured.
struct ProbeRequest {
  std::string method = "auto";  // in OcclusionMethods(), or "auto"
  bool parts = false;           // direct light and gradients, too
};

// A solved scene. Several threads may use it at once. No function touches an object of Python.
class PythonSolution {
 public:
  // Takes a pipeline that is solved and has a mesh. `options` are those of OptionsUsed(). If `measured`, its
  // error has been measured.
  PythonSolution(PythonScene scene, std::unique_ptr<Pipeline> pipeline, nlohmann::ordered_json options,
                 bool measured);
  // The solution in a file. Throws InputError.
  static std::shared_ptr<PythonSolution> Load(const std::string& path);

  const PythonScene& scene() const { return scene_; }
  const Pipeline& pipeline() const { return *pipeline_; }
  const nlohmann::ordered_json& options() const { return options_; }

  // Measures irradiance as the command `probe` does. Unspecified if cancelled.
  std::vector<Measurement> Probe(const std::vector<ProbePoint>& points, const ProbeRequest& request,
                                 const ExecutionContext& context) const;

  // Held by whoever calls the functions below: the results of measuring may change, and meshes be added.
  std::mutex& Busy() const { return busy_; }
  // Measures the error, unless it has been measured.
  void Measure(const ExecutionContext& context);
  // The bytes of a solution file. REQUIRES: Measure() was not cancelled.
  std::string FileBytes() const;
  // The mesh of this kind for the same light, made at the first call. Null if cancelled.
  const IrradianceMesh* MeshOfKind(MeshKind kind, const ExecutionContext& context) const;

 private:
  // With direct light and gradients if `parts`.
  Prober MakeProber(const PointIrradiance& irradiance, bool parts) const {
    return Prober(*scene_.scene, irradiance, pipeline_.get(), parts);
  }

  const PythonScene scene_;
  std::unique_ptr<Pipeline> pipeline_;
  nlohmann::ordered_json options_;
  bool measured_ = false;
  mutable std::mutex busy_, probing_;
  // For points in the usual way, made at the first call.
  mutable std::unique_ptr<const PointIrradiance> irradiance_;
  mutable std::unique_ptr<const Prober> prober_;
  mutable std::map<MeshKind, IrradianceMesh> other_meshes_;
};

// A solve that is made step by step.
struct PythonSolver {
  PythonScene scene;
  std::unique_ptr<Pipeline> pipeline;  // null once finished
  nlohmann::ordered_json options;
  bool linked = false;
  std::mutex busy;
};

}  // namespace penumbra
