/// The proof that a stimulus goes to the display as it should: every page, drawn through OpenGL, read back,
/// decoded and compared.
#pragma once

#include <functional>
#include <vector>

#include "experiment/base/content_hash.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/session_log.h"
#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"
#include "render/image/gamut.h"
#include "render/presenter/page_presenter.h"
#include "render/signal/signal_check.h"

namespace overt {

struct PageVerification {
    int page = 0;
    SignalFindings findings;
    ContentHash signal_sha256; ///< of all bytes of the screen, as they go to the display
    ClippedPixels clipped;     ///< of the page's light
};

/// Draws each page of a stimulus once, without showing it. `pages` and `presenter` belong together; `display`
/// and `eye` are what the presenter was made for.
std::vector<PageVerification> verify_pages(PagePresenter& presenter, const FrameSource& pages,
                                           const Stimulus& stimulus, const ScreenGeometry& geometry,
                                           const DisplaySettings& display, Eye eye = Eye::left);

/// Told before each stimulus.
using StimulusProgress = std::function<void(int done, int total)>;

/// Verifies each stimulus of a schedule and writes an event "output verified" for each page. Throws
/// GraphicsError, once all is written, if a single value differs from its prediction. `presenters`: by eye,
/// where each has pictures of its own; else one.
void record_verification(std::span<PagePresenter* const> presenters, const FrameSource& pages,
                         const Protocol& protocol, const Schedule& schedule, const Clock& clock,
                         SessionLog& log, const StimulusProgress& progress);

} // namespace overt
