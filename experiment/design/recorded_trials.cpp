#include "experiment/design/recorded_trials.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "experiment/factors.h"
#include "experiment/protocol/all_stimuli.h"

namespace overt {

namespace {

/// What a trial shows in a motion of kind "recorded".
std::vector<PlacedStimulus> yoked_places(const Protocol& protocol, const Trial& trial) {
    std::vector<PlacedStimulus> yoked = trial.all_shown();
    std::erase_if(yoked, [&](const PlacedStimulus& placed) {
        return protocol.motion_of(placed.stimulus).kind != MotionKind::recorded;
    });
    return yoked;
}

bool is_in_slot(const Protocol& protocol, const RecordedCourse& course, const PlacedStimulus& placed) {
    return course.slot == protocol.slots[static_cast<std::size_t>(placed.slot)].id;
}

bool is_of_stimulus(const Protocol& protocol, const RecordedCourse& course, const Stimulus& stimulus) {
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        const std::string& recorded = course.stimulus[list];
        if (!recorded.empty() &&
            recorded !=
                entries_of(protocol, list)[static_cast<std::size_t>(stimulus.*stimulus_lists[list].index)]
                    ->id)
            return false;
    }
    return true;
}

/// Of one observer.
class Yoking {
  public:
    Yoking(const Protocol& protocol, int observer_number, bool is_practice)
        : protocol_(protocol), number_(observer_number), is_practice_(is_practice) {}

    /// What is wrong.
    std::optional<std::string> add_level(Trial& trial) {
        const std::vector<PlacedStimulus> places = yoked_places(protocol_, trial);
        if (places.empty())
            return std::nullopt;
        if (const std::string_view said = own_level(trial, yoked_to); !said.empty())
            return has_all(places, said)
                       ? std::nullopt
                       : std::optional(fmt::format("no recording has a \"{}\" with each slot "
                                                   "that it is shown in",
                                                   said));
        const MotionSettings& motion = protocol_.motion_of(places.front().stimulus);
        const std::vector<std::string_view> all = whose_courses(motion.courses);
        if (all.empty())
            return fmt::format("motion \"{}\" has no recording", motion.id);
        const std::string_view whose = all[static_cast<std::size_t>(number_ - 1) % all.size()];
        std::vector<std::string> names = names_for(places, whose, trial, true);
        if (names.empty() && is_practice_)
            names = names_for(places, whose, trial, false);
        if (names.empty())
            return why_none(motion, whose, trial, places.front());
        int& earlier = shown_[key_of(places)];
        trial.levels.push_back(
            {std::string(yoked_to), names[static_cast<std::size_t>(earlier++) % names.size()]});
        return std::nullopt;
    }

  private:
    bool has_all(const std::vector<PlacedStimulus>& places, std::string_view name) const {
        return std::ranges::all_of(places, [&](const PlacedStimulus& placed) {
            return std::ranges::any_of(protocol_.motion_of(placed.stimulus).courses, [&](const auto& course) {
                return course.name() == name && is_in_slot(protocol_, course, placed);
            });
        });
    }

    /// Each trial once, in the order of the recording.
    std::vector<std::string> names_for(const std::vector<PlacedStimulus>& places, std::string_view whose,
                                       const Trial& trial, bool is_matched) const {
        std::vector<std::string> names;
        const MotionSettings& motion = protocol_.motion_of(places.front().stimulus);
        for (const RecordedCourse& course : motion.courses) {
            const bool fits = motion.matched_by == CourseMatch::trial && !is_practice_
                                  ? course.trial == trial.index + 1
                                  : !is_matched || fits_all(course.name(), places);
            const std::string name = course.name();
            if (fits && course.whose == whose && std::ranges::find(names, name) == names.end() &&
                has_all(places, name))
                names.push_back(name);
        }
        return names;
    }

    bool fits_all(std::string_view name, const std::vector<PlacedStimulus>& places) const {
        return std::ranges::all_of(places, [&](const PlacedStimulus& placed) {
            return std::ranges::any_of(protocol_.motion_of(placed.stimulus).courses, [&](const auto& course) {
                return is_in_slot(protocol_, course, placed) &&
                       is_of_stimulus(protocol_, course, placed.stimulus) && course.name() == name;
            });
        });
    }

    std::string why_none(const MotionSettings& motion, std::string_view whose, const Trial& trial,
                         const PlacedStimulus& placed) const {
        const std::string& slot = protocol_.slots[static_cast<std::size_t>(placed.slot)].id;
        return motion.matched_by == CourseMatch::trial
                   ? fmt::format(
                         "trial {} shows motion \"{}\" in slot \"{}\", and {} has no such trial there",
                         trial.index + 1, motion.id, slot, whose)
                   : fmt::format("\"{}\" is shown in slot \"{}\", and {} has no trial with it there",
                                 stimulus_in_words(protocol_, placed.stimulus), slot, whose);
    }

    static std::vector<PlacedStimulus> sorted(std::vector<PlacedStimulus> places) {
        std::ranges::sort(places, {}, &PlacedStimulus::slot);
        return places;
    }
    static std::vector<std::pair<Stimulus, int>> key_of(const std::vector<PlacedStimulus>& places) {
        std::vector<std::pair<Stimulus, int>> key;
        for (const PlacedStimulus& placed : sorted(places))
            key.emplace_back(placed.stimulus, placed.slot);
        return key;
    }

    const Protocol& protocol_;
    int number_;
    bool is_practice_;
    std::map<std::vector<std::pair<Stimulus, int>>, int> shown_; ///< how often so far
};

} // namespace

bool is_yoked(const Protocol& protocol, const Trial& trial) { return !yoked_places(protocol, trial).empty(); }

std::optional<std::string> yoke(const Protocol& protocol, int observer_number, std::span<Trial> trials,
                                bool is_practice) {
    std::optional<std::string> wrong;
    if (std::ranges::none_of(protocol.motions, [](const MotionSettings& motion) {
            return motion.kind == MotionKind::recorded;
        }))
        return wrong;
    Yoking yoking(protocol, observer_number, is_practice);
    for (Trial& trial : trials)
        if (std::optional<std::string> fault = yoking.add_level(trial); fault && !wrong)
            wrong = std::move(fault);
    return wrong;
}

const RecordedCourse* course_of(const Protocol& protocol, const Trial& trial, std::size_t place, int show) {
    const PlacedStimulus placed = trial.shown(place);
    const std::string_view name = own_level(trial, yoked_to);
    const RecordedCourse* found = nullptr;
    for (const RecordedCourse& course : protocol.motion_of(placed.stimulus).courses)
        if (course.name() == name && is_in_slot(protocol, course, placed)) {
            found = &course;
            if (show-- == 0)
                break;
        }
    return found;
}

} // namespace overt
