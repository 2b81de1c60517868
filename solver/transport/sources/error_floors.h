// solver/transport/sources/error_floors.h
//
// Floors of relative errors: the smallest denominators. A relative error is |difference| / max(light, floor),
// because division by the light alone would demand an accuracy in dark places that nobody can see. Each floor
// (smallest denominator of a relative error) is a fraction of a mean over the scene, for each channel
// separately.

#pragma once

namespace penumbra {

// The floor of relative errors that the option `--error` limits (PipelineOptions::error), as a fraction of
// the mean irradiance. The constant kErrorFloor is also the floor for the error of replacing a subtree of a
// source's quadtree by one polygon (SourceSet).
inline constexpr double kErrorFloor = 0.01;
// The error that a missing shadow discontinuity would cause is divided by max(mean irradiance of the leaf,
// kLeafFloor * mean irradiance of the scene). The constant kLeafFloor is higher than kErrorFloor because a
// leaf may have places that are much darker than the mean irradiance of the leaf.
inline constexpr double kLeafFloor = 0.05;
// The floor for the relative deviation of radiosity within a cell of the mesh that serves as a light source
// (SourceCells), as a fraction of the mean reflected radiosity. The constant kCellFloor is higher than
// kErrorFloor because the error of a source affects many receivers, at most of which the irradiance exceeds
// kErrorFloor * (mean irradiance).
inline constexpr double kCellFloor = 0.05;
// The floor for the relative error of the parts into which deferred corrections cut leaves (LeafCells), as a
// fraction of the mean reflected radiosity. The constant kPartFloor is high because the error of each part of
// a leaf is bounded separately, without regard to the irradiance that arrives at receivers.
inline constexpr double kPartFloor = 0.5;

}  // namespace penumbra
