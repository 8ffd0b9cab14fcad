/// The frames and maps of a recorded session, made again.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "app/cli/context_choice.h"
#include "app/inputs/protocol_inputs.h"
#include "app/rig/open_display.h"
#include "experiment/record/read/session_record.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

/// A context in memory, and the library that draws in it. On the main thread.
class StimuliAgain {
  public:
    /// `experiment` must outlive this. Throws GraphicsError and InputError.
    StimuliAgain(const Experiment& experiment, const std::filesystem::path& cache, ContextChoice context);

    StimulusLibrary& library() { return *library_; }
    const GlContext& context() const { return display_.context(); }

    /// Makes maps, and frames as good as the session had to have, as far as that is a matter of minutes.
    /// Gives why there are no frames; empty if there are. Throws what cannot be mended by a bake.
    std::string prepare(const SessionRecord& record, const Protocol& protocol);

  private:
    OpenDisplay display_;
    std::unique_ptr<StimulusLibrary> library_;
};

/// The context that a record names; a window's pictures are drawn in memory.
ContextChoice context_of(const SessionHeader& header);

/// The program's cache of rendered frames, at `work`; maps, and what is made of frames, are missing there.
std::filesystem::path cache_without_maps(const std::filesystem::path& cache,
                                         const std::filesystem::path& work);

} // namespace overt
