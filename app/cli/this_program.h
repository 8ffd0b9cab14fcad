/// What a record says of the program that wrote it.
#pragma once

#include <string>

#include "experiment/record/manifest.h"
#include "experiment/record/session_header.h"

namespace overt {

/// Version, compiler, flags and commit.
ProgramBuild this_build();

/// What `overt --version` prints: the version on a line of its own, commit, build type, compiler and flags,
/// and the versions of the libraries that it was built with.
std::string version_text();

/// This program as a manifest names it: its version and the hash of its executable, which is read once.
/// Throws InputError if that cannot be read.
SessionManifest::Program this_program();

/// Now, by the wall clock: 2026-11-21T09:30:00Z.
std::string utc_now();

} // namespace overt
