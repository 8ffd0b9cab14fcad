/// What an output of markers does. ThreadedMarkerSink makes a MarkerSink of it.
#pragma once

#include <string>

#include "experiment/ports/marker_sink.h"

namespace overt {

/// On one thread at a time, which may wait: that of the sink, and the session's before and after it.
class MarkerOutput {
  public:
    virtual ~MarkerOutput() = default;
    virtual const std::string& name() const noexcept = 0;
    /// Whether it tells the code alone; markers without one are passed over then.
    virtual bool needs_code() const noexcept = 0;
    /// Raises the code, or tells the text. False if the output is gone or does not take it.
    virtual bool send(const Marker& marker) noexcept = 0;
    /// Ends the pulse, where a code stays until it is taken back.
    virtual void rest() noexcept {}
    /// Why send() gave false; empty while it did not.
    virtual std::string fault() const { return {}; }
};

} // namespace overt
