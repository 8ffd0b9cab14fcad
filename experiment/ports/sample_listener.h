/// Who is told of gaze samples as soon as they come, before a session takes them.
#pragma once

#include "experiment/gaze.h"

namespace overt {

class SampleListener {
  public:
    virtual ~SampleListener() = default;
    /// On the thread that reads the tracker, always the same one while it records. Must not wait, allocate or
    /// throw.
    virtual void measured(const GazeSample& sample) noexcept = 0;
};

} // namespace overt
