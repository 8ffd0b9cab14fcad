#include "experiment/protocol/all_stimuli.h"

#include <algorithm>

#include "experiment/base/error.h"

namespace overt {

std::vector<Stimulus> all_stimuli(const Protocol& protocol) {
    std::vector<Stimulus> stimuli{{}};
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        std::vector<Stimulus> longer;
        const int entries = static_cast<int>(entries_of(protocol, list).size());
        for (Stimulus stimulus : stimuli) {
            for (int entry = 0; entry < entries; ++entry) {
                stimulus.*stimulus_lists[list].index = entry;
                longer.push_back(stimulus);
            }
        }
        stimuli = std::move(longer);
    }
    return stimuli;
}

std::vector<Stimulus> at_all_sizes(const Protocol& protocol, const Stimulus& stimulus) {
    std::vector<Stimulus> all;
    const auto views = static_cast<int>(protocol.views.size());
    for (int view = stimulus.view; view < static_cast<int>(protocol.views_at_all_sizes()); view += views) {
        all.push_back(stimulus);
        all.back().view = view;
    }
    return all;
}

std::vector<Stimulus> stimuli_in_slots(const Protocol& protocol) {
    std::vector<Stimulus> all = all_stimuli(protocol);
    const std::vector<Stimulus> first = all;
    const auto views = static_cast<int>(protocol.views.size());
    for (int more = views; more < static_cast<int>(protocol.views_at_all_sizes()); more += views)
        for (Stimulus stimulus : first) {
            stimulus.view += more;
            all.push_back(stimulus);
        }
    return all;
}

Stimulus stimulus_of(const Protocol& protocol, const FrameSequenceSettings& frames) {
    const std::vector<Stimulus> stimuli = all_stimuli(protocol);
    const auto found = std::ranges::find_if(
        stimuli, [&](const Stimulus& stimulus) { return find_frames(protocol, stimulus) == &frames; });
    OVERT_EXPECTS(found != stimuli.end());
    return *found;
}

PoseTable poses_of(const Protocol& protocol) {
    PoseTable poses;
    for (const Animation& motion : protocol.motions)
        poses.add(motion);
    return poses;
}

std::vector<PageCycle> page_cycles(const Protocol& protocol) {
    const PoseTable poses = poses_of(protocol);
    std::vector<PageCycle> cycles;
    for (const Animation& motion : protocol.motions)
        cycles.push_back(make_page_cycle(motion, poses.frames_of(static_cast<int>(cycles.size())),
                                         protocol.display.refresh_hz));
    return cycles;
}

std::vector<ViewedObject> all_viewed_objects(const Protocol& protocol) {
    std::vector<ViewedObject> all;
    for (int object = 0; object < static_cast<int>(protocol.objects.size()); ++object) {
        for (int view = 0; view < static_cast<int>(protocol.views_at_all_sizes()); ++view)
            all.push_back({object, view});
    }
    return all;
}

bool is_named(std::size_t list, std::size_t entries) {
    return stimulus_lists.at(list).is_always_named || entries > 1;
}

namespace {

/// Views count on with the sizes of slots, and with the right eye.
int views_of_an_eye(const Protocol& protocol) {
    return static_cast<int>(protocol.views_at_all_sizes()) / (protocol.stereo.is_on() ? 2 : 1);
}

/// "left" or "right"; empty where both eyes have the same.
std::string_view eye_of_view(const Protocol& protocol, int view) {
    if (!protocol.stereo.is_on())
        return {};
    return view < views_of_an_eye(protocol) ? "left" : "right";
}

/// The first slot with the size of a view, if it is not the first size.
std::string slot_of_size(const Protocol& protocol, int view) {
    const int size = view % views_of_an_eye(protocol) / static_cast<int>(protocol.views.size());
    const auto slot = std::ranges::find(protocol.slots, size, &Slot::size);
    return size == 0 || slot == protocol.slots.end() ? "" : slot->id;
}

std::string joined(const Protocol& protocol, const Stimulus& stimulus, std::string ListEntry::*what,
                   std::string_view between) {
    std::string name;
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        const std::vector<const ListEntry*> entries = entries_of(protocol, list);
        if (!is_named(list, entries.size()))
            continue;
        if (!name.empty())
            name += between;
        name +=
            entries[static_cast<std::size_t>(stimulus.*stimulus_lists[list].index) % entries.size()]->*what;
    }
    const std::string slot = slot_of_size(protocol, stimulus.view);
    if (!slot.empty())
        name.append(between).append(slot);
    return name;
}

} // namespace

std::string stimulus_name(const Protocol& protocol, const Stimulus& stimulus, char between) {
    std::string name = joined(protocol, stimulus, &ListEntry::id, std::string_view(&between, 1));
    if (const std::string_view eye = eye_of_view(protocol, stimulus.view); !eye.empty())
        (name += between) += eye;
    return name;
}

std::string stimulus_in_words(const Protocol& protocol, const Stimulus& stimulus) {
    return joined(protocol, stimulus, &ListEntry::id, ", ");
}

std::string stimulus_title(const Protocol& protocol, const Stimulus& stimulus) {
    return joined(protocol, stimulus, &ListEntry::title, ", ");
}

std::string section_of_view(const Protocol& protocol, int view) {
    return protocol.views.size() > 1 ? "[[view]] " + protocol.view_at(view).id : "[view]";
}

std::string viewed_name(const Protocol& protocol, const ViewedObject& viewed, char between) {
    std::string name = protocol.objects[static_cast<std::size_t>(viewed.object)].id;
    if (protocol.views.size() > 1)
        name += between + protocol.view_at(viewed.view).id;
    if (const std::string slot = slot_of_size(protocol, viewed.view); !slot.empty())
        name += between + slot;
    if (const std::string_view eye = eye_of_view(protocol, viewed.view); !eye.empty())
        (name += between) += eye;
    return name;
}

} // namespace overt
