/// What one observer does in one sitting: trials, each a question about one stimulus.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/base/enum_names.h"

namespace overt {

/// What the observer looks at: an object in a material, under a light, in a motion, in a view, before a
/// background. Indices into the protocol's lists. What is made of a stimulus for a slot whose image has
/// another size than the first slot's has a view beyond the list: see Protocol::in_slot.
struct Stimulus {
    int object = 0;
    int material = 0;
    int light = 0;
    int motion = 0;
    int view = 0;
    int background = 0;
    friend constexpr auto operator<=>(const Stimulus&, const Stimulus&) = default;
};

/// An object in a view: what maps show, whatever its material and its light.
struct ViewedObject {
    int object = 0;
    int view = 0;
    friend constexpr auto operator<=>(const ViewedObject&, const ViewedObject&) = default;
};
constexpr ViewedObject viewed(const Stimulus& stimulus) { return {stimulus.object, stimulus.view}; }

/// A stimulus and where it is shown: an index into the protocol's slots.
struct PlacedStimulus {
    Stimulus stimulus;
    int slot = 0;
    friend constexpr bool operator==(const PlacedStimulus&, const PlacedStimulus&) = default;
};

/// A level of a factor that a trial has by itself, whatever its stimuli: a column of a table of trials, the
/// set size of a search.
struct TrialLevel {
    std::string factor;
    std::string level; ///< a number as it is written in tables
    friend bool operator==(const TrialLevel&, const TrialLevel&) = default;
};

/// What a trial is there for. Results are of trials proper.
enum class TrialRole : std::uint8_t {
    trial,
    catch_trial, ///< checks the observer, mixed in among the others
    practice     ///< of a block of practice: all is recorded of it
};
template <> inline constexpr auto names_of<TrialRole> = enum_names<TrialRole>("trial", "catch", "practice");

/// What is shown under one task: most often one stimulus, else one in each of several slots. A slot of the
/// task that has none stays empty.
struct Trial {
    int index = 0; ///< position in the observer's order, from 0
    int task = 0;  ///< index into the protocol's tasks
    Stimulus stimulus;
    int block = 0;                           ///< index into the protocol's blocks; 0 if it has none
    int slot = 0;                            ///< of `stimulus`
    std::vector<PlacedStimulus> beside = {}; ///< in further slots, each once, in the task's order
    std::vector<TrialLevel> levels = {};     ///< of its own factors
    std::string correct = {};                ///< the correct answer; empty: there is none, or nobody knows it
    TrialRole role = TrialRole::trial;
    friend bool operator==(const Trial&, const Trial&) = default;

    std::size_t shown_count() const { return 1 + beside.size(); }
    std::vector<PlacedStimulus> all_shown() const {
        std::vector<PlacedStimulus> all{shown(0)};
        all.insert(all.end(), beside.begin(), beside.end());
        return all;
    }
    /// The same trial, as if it had no more than these of its stimuli, rising and one at least.
    Trial only(const std::vector<int>& places) const {
        Trial part = *this;
        const PlacedStimulus first = shown(static_cast<std::size_t>(places.front()));
        part.stimulus = first.stimulus;
        part.slot = first.slot;
        part.beside.clear();
        for (std::size_t i = 1; i < places.size(); ++i)
            part.beside.push_back(shown(static_cast<std::size_t>(places[i])));
        return part;
    }
    /// The i-th that it shows, `stimulus` being the 0th.
    PlacedStimulus shown(std::size_t i) const {
        return i == 0 ? PlacedStimulus{stimulus, slot} : beside[i - 1];
    }
};

/// Who sits there. `number` counts observers from 1 and decides the rotation of materials; `label` is what
/// files are named by.
struct Observer {
    std::string label;
    int number = 1;
};

/// The order of one observer's trials, and the seed from which it can be made again.
struct Schedule {
    Observer observer;
    std::uint64_t seed = 0;
    std::vector<Trial> trials;
    bool is_even = true; ///< no order that keeps to the limits was more probable than another; not recorded
};

} // namespace overt
