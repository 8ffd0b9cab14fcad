/// Several tracks at once, one of them drawn for each trial among those that have not ended, so that the
/// observer cannot tell what comes next.
#pragma once

#include <memory>
#include <vector>

#include "experiment/procedures/level_track.h"

namespace overt {

class InterleavedTracks {
  public:
    /// Which track a trial takes follows from the seed and the trial's number alone.
    InterleavedTracks(std::vector<std::unique_ptr<LevelTrack>> tracks, std::uint64_t seed);

    struct Choice {
        std::size_t track = 0;
        double level = 0.0;
        friend bool operator==(const Choice&, const Choice&) = default;
    };
    /// What the next trial shows; nothing when all tracks have ended. The same until tell().
    std::optional<Choice> next() const;

    /// The answer of the trial that next() chose, and the level that was shown.
    void tell(double shown, TrackAnswer answer);

    const LevelTrack& track(std::size_t index) const { return *tracks_[index]; }
    std::size_t size() const { return tracks_.size(); }

  private:
    std::vector<std::unique_ptr<LevelTrack>> tracks_;
    std::uint64_t seed_;
    std::uint64_t trials_ = 0;
};

} // namespace overt
