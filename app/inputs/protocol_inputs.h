/// What a protocol names, looked into before anybody sits down: meshes, light and ready-made frames.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "experiment/base/diagnostics.h"
#include "experiment/protocol/protocol.h"
#include "experiment/record/session_header.h"
#include "experiment/stimulus/object.h"

namespace overt {

/// A sound protocol with its objects.
struct Experiment {
    Protocol protocol;
    std::vector<Object> objects; ///< in the protocol's order
};

/// How much of what a protocol names is looked into. Ready-made frames are many, and reading all of them
/// takes seconds.
enum class InputDepth { objects, everything };

/// Reads a protocol and what it names. What is wrong with a file is found at the key that names it; remarks
/// on a mesh are warnings. Nothing if there is an error. Throws only for what is no input's fault.
std::optional<Experiment> read_experiment(const std::filesystem::path& file,
                                          const std::filesystem::path& cache, InputDepth depth,
                                          Diagnostics& diagnostics);

/// The same from a protocol as a session has recorded it, `file` being where it lies or would lie: what it
/// names is looked up from there.
std::optional<Experiment> read_recorded_experiment(const RecordedProtocol& recorded,
                                                   const std::filesystem::path& file,
                                                   const std::filesystem::path& cache,
                                                   Diagnostics& diagnostics);

/// The same as read_experiment(), with all findings printed to standard error; throws FindingsPrinted if one
/// of them is an error.
Experiment read_experiment_or_report(const std::filesystem::path& file, const std::filesystem::path& cache,
                                     InputDepth depth);

} // namespace overt
