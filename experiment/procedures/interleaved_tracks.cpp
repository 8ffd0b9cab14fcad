#include "experiment/procedures/interleaved_tracks.h"

#include <utility>

#include "experiment/base/random.h"

namespace overt {

InterleavedTracks::InterleavedTracks(std::vector<std::unique_ptr<LevelTrack>> tracks, std::uint64_t seed)
    : tracks_(std::move(tracks)), seed_(seed) {}

std::optional<InterleavedTracks::Choice> InterleavedTracks::next() const {
    std::vector<Choice> open;
    for (std::size_t i = 0; i < tracks_.size(); ++i)
        if (const std::optional<double> level = tracks_[i]->next())
            open.push_back({i, *level});
    if (open.empty())
        return std::nullopt;
    RandomStream random(seed_, "interleaved tracks", trials_);
    return open[random.below(static_cast<std::uint32_t>(open.size()))];
}

void InterleavedTracks::tell(double shown, TrackAnswer answer) {
    const std::optional<Choice> choice = next();
    if (!choice)
        return;
    tracks_[choice->track]->tell(shown, answer);
    ++trials_;
}

} // namespace overt
