/// What the sub-benchmarks of `overt bench` share: the figures they give and the figures in stone they
/// measure on.
#pragma once

#include <vector>

#include "app/bench/bench_commands.h"
#include "app/cli/figures.h"
#include "experiment/stimulus/object.h"

namespace overt {

/// What a benchmark measures on: a protocol with its objects.
struct BenchScene {
    Protocol protocol;
    std::vector<Object> objects;
};

/// The object of --mesh, else the shipped ones, in the default experiment with a picture of --size. Throws
/// InputError as load_object does.
BenchScene bench_scene(const BenchOptions& options);

// The sub-benchmarks, each in a file of its name.
BenchFigures bench_lut(const BenchOptions& options); ///< the hidden pass: its exactness, time and memory
/// Gaze to surface: its speed, exactness and memory.
BenchFigures bench_reproject(const BenchOptions& options);
/// A flip of a 1920 x 1080 Color++ frame with its page: time, processor time, packing and memory.
BenchFigures bench_present(const BenchOptions& options);
/// Ready-made frames from files to the frame store, against the libraries of pictures alone.
BenchFigures bench_frames(const BenchOptions& options);
/// A baked frame of each material: its time beside that of its rays, its errors against many samples, and
/// what a whole bake takes.
BenchFigures bench_bake(const BenchOptions& options);
/// Exports and imports: their speed, and their memory on a session and on one four times as long.
BenchFigures bench_export(const BenchOptions& options);
/// Fixations and saccades against a tracker's own, people's labels, or planted ones.
BenchFigures bench_events(const BenchOptions& options);
/// A study of given sessions, the voxels' Gaussian and maps along the surface: speed, memory, exactness.
BenchFigures bench_analyze(const BenchOptions& options);
/// Simulated studies of 12 observers: how many a minute on one core.
BenchFigures bench_power(const BenchOptions& options);
/// An eye tracker at 2000 Hz: samples lost or doubled, processor time, refreshes missed beside it.
BenchFigures bench_tracker(const BenchOptions& options);
/// A thousand trials whose gaze is planted: whether the step that waits for it ends by the very sample.
BenchFigures bench_gaze_step(const BenchOptions& options);
/// Keys that are sent to a window of X: how long each takes to be seen.
BenchFigures bench_input(const BenchOptions& options);
/// Procedures that choose levels, and fits of answers, against known answers and simulated observers.
BenchFigures bench_procedures(const BenchOptions& options);
/// Each p and each interval of the analysis in simulated studies whose truth is known: false positives,
/// coverage.
BenchFigures bench_statistics(const BenchOptions& options);
/// Time and memory of whole commands as sessions have more trials, and studies more sessions; the exponents.
BenchFigures bench_growth(const BenchOptions& options);
/// Layered surfaces against laws of light and numbers that others worked out.
BenchFigures bench_materials(const BenchOptions& options);
/// Live frames of each kind of material against baked ones, in CIEDE2000.
BenchFigures bench_live(const BenchOptions& options);
/// The operator's view: from a sample to its surface point, and to its mark in the window.
BenchFigures bench_watch(const BenchOptions& options);

} // namespace overt
