// solver/transport/sources/error_floors.h
//
// Smallest denominators of relative errors. A relative error is |difference| / max(light, floor): in dark
// places, division by the light itself would demand an accuracy that nobody sees. Each floor is a fraction of
// a mean over the scene, for each channel separately.

#pragma once

namespace penumbra {

// The floor, as a fraction of the mean irradiance, for the error that `--error` promises
// (PipelineOptions::error), and for the error of replacing a subtree of a source by one polygon (SourceSet).
inline constexpr double kErrorFloor = 0.01;
// The floor, as a fraction of the mean irradiance, for the weights of discontinuities, which are relative to
// the mean irradiance of a leaf. kLeafFloor is higher than kErrorFloor because the mean of a leaf does not
// show its dark places.
inline constexpr double kLeafFloor = 0.05;
// The floor, as a fraction of the mean reflected radiosity, for the deviation within a cell of the mesh that
// is used as a source (SourceCells). kCellFloor is higher than kErrorFloor because the error affects many
// receivers, most of which are brighter than kErrorFloor.
inline constexpr double kCellFloor = 0.05;
// The floor, as a fraction of the mean reflected radiosity, for the parts into which corrections cut leaves
// (LeafCells). kPartFloor is high because the error of each part is bounded separately, without regard to the
// irradiance that arrives at receivers.
inline constexpr double kPartFloor = 0.5;

}  // namespace penumbra
