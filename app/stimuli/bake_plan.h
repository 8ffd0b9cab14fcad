/// Which frames are to be rendered, and by whom.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/cli/shard.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

/// One frame to render: of a stimulus, one of the pictures of its motion.
struct BakeUnit {
    Stimulus stimulus;
    Pose pose;
    double cost = 0.0;    ///< see expected_cost(); 0 of what is added up
    bool is_part = false; ///< rendered for the light of others to be added up, and not asked for itself
};

/// Frames by their numbers, both ends among them. "7", "0-30" or "all". Throws InputError for others, or for
/// frames that no motion of the stimuli has. Of a motion with fewer frames it holds those that there are.
struct FrameRange {
    int first = 0, last = 0;
    bool holds(int frame) const { return frame >= first && frame <= last; }
};
FrameRange frame_range_called(const std::string& text, const Protocol& protocol,
                              std::span<const Stimulus> stimuli);

/// All frames of the stimuli, in their order and that of pictures; a picture is among them if a frame of the
/// range shows it. Before what is added up of frames under several lights come those frames, as parts. A
/// frame that stimuli share is the first one's, unless each has files of its own.
std::vector<BakeUnit> bake_units(const std::vector<Stimulus>& stimuli, const FrameRange& frames,
                                 const StimulusCache& cache, const FrameQuality& quality,
                                 bool is_each_its_own);

/// What one shard has to do of it: dealt out by expected cost, the dearest first, each to the shard that has
/// least so far. It depends on nothing but the arguments, and the shards 1/n … n/n have each unit once.
std::vector<BakeUnit> dealt_to(const Shard& shard, const std::vector<BakeUnit>& units);

} // namespace overt
