/// What a level meter on the screen shows of an answer while it is spoken.
#pragma once

#include <optional>
#include <string>

#include "experiment/ports/presenter.h"
#include "experiment/ports/recorded_answer.h"
#include "experiment/protocol/sitting_settings.h"

namespace overt {

class LevelWatch {
  public:
    /// `since`: when the answer could begin. `words` must outlive the watch.
    LevelWatch(const WordSettings& words, SessionTime since) : words_(words), since_(since), drawn_(since) {}

    /// Takes the level of an instant. Gives a bar at most ten times a second: the largest mean and peak
    /// since the last one, from -60 dB of full scale to full scale. It warns for two seconds after clipping,
    /// and where nothing was louder than -40 dB in the first five seconds.
    std::optional<LevelBar> take(const AudioLevel& level, SessionTime now);

  private:
    const WordSettings& words_;
    SessionTime since_, drawn_;
    std::optional<SessionTime> clipped_;
    AudioLevel loudest_;
    bool was_heard_ = false;
};

} // namespace overt
