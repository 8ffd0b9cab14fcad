#include "experiment/record/session_header.h"

#include <algorithm>
#include <type_traits>

namespace overt {

std::vector<ListEntry> entries_of(const SessionHeader& header, std::size_t list) {
    std::vector<ListEntry> entries;
    std::size_t at = 0;
    const auto take = [&](auto of_list) {
        if (at++ == list)
            for (const auto& entry : header.*of_list)
                entries.push_back({entry.id, entry.title, entry.columns, {}});
    };
    std::apply([&](auto... of_list) { (take(of_list), ...); }, recorded_lists);
    if (entries.empty()) {
        const std::string name(stimulus_lists[list].name);
        entries.push_back({name, name, {}, {}});
    }
    return entries;
}

void record_entries(SessionHeader& header, std::size_t list, const std::vector<const ListEntry*>& entries) {
    std::size_t at = 0;
    const auto put = [&](auto of_list) {
        if (at++ != list)
            return;
        auto& recorded = header.*of_list;
        if constexpr (std::is_same_v<std::remove_reference_t<decltype(recorded)>, std::vector<ListEntry>>)
            for (const ListEntry* entry : entries)
                recorded.push_back({entry->id, entry->title, entry->columns, {}});
        else
            for (std::size_t i = 0; i < std::min(recorded.size(), entries.size()); ++i)
                recorded[i].columns = entries[i]->columns;
    };
    std::apply([&](auto... of_list) { (put(of_list), ...); }, recorded_lists);
}

std::array<std::size_t, stimulus_lists.size()> entry_counts(const SessionHeader& header) {
    std::array<std::size_t, stimulus_lists.size()> counts{};
    for (std::size_t list = 0; list < counts.size(); ++list)
        counts[list] = entries_of(header, list).size();
    return counts;
}

Factors factors_of(const SessionHeader& header) {
    FactorSources sources;
    for (const RecordedTask& task : header.tasks)
        sources.tasks.push_back(task.id);
    sources.blocks = header.blocks;
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        sources.lists[list] = entries_of(header, list);
    return Factors(sources);
}

namespace {

/// The first slot of each size.
std::vector<int> slots_of_sizes(const SessionHeader& header) {
    std::vector<int> first;
    for (std::size_t slot = 0; slot < header.slots.size(); ++slot)
        if (std::ranges::none_of(first, [&](int had) {
                return header.slots[static_cast<std::size_t>(had)].size_px == header.slots[slot].size_px;
            }))
            first.push_back(static_cast<int>(slot));
    return first;
}

int views_of_list(const SessionHeader& header) {
    return static_cast<int>(std::max<std::size_t>(1, header.views.size()));
}

/// Which of the sizes that slots have.
std::size_t size_of_view(const SessionHeader& header, int view) {
    return static_cast<std::size_t>(view % static_cast<int>(header.views_of_an_eye()) /
                                    views_of_list(header));
}

} // namespace

std::size_t SessionHeader::views_of_an_eye() const {
    return static_cast<std::size_t>(views_of_list(*this)) *
           std::max<std::size_t>(1, slots_of_sizes(*this).size());
}

Stimulus SessionHeader::in_slot(const PlacedStimulus& placed, Eye eye) const {
    Stimulus shown = placed.stimulus;
    if (!display.stereo.empty() && eye == Eye::right)
        shown.view += static_cast<int>(views_of_an_eye());
    if (placed.slot < 0 || static_cast<std::size_t>(placed.slot) >= slots.size())
        return shown;
    const std::vector<int> first = slots_of_sizes(*this);
    const auto size = std::ranges::find_if(first, [&](int slot) {
        return slots[static_cast<std::size_t>(slot)].size_px ==
               slots[static_cast<std::size_t>(placed.slot)].size_px;
    });
    shown.view += static_cast<int>(size - first.begin()) * views_of_list(*this);
    return shown;
}

ScreenGeometry SessionHeader::screen_of_view(int view) const {
    const std::vector<int> first = slots_of_sizes(*this);
    const std::size_t size = size_of_view(*this, view);
    return size > 0 && size < first.size() ? screen_of_slot(first[size]) : display.screen;
}

std::string stimulus_name(const SessionHeader& header, const Stimulus& stimulus, std::string_view between) {
    std::string name;
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        const std::vector<ListEntry> entries = entries_of(header, list);
        if (entries.size() < 2 && !stimulus_lists[list].is_always_named)
            continue;
        if (!name.empty())
            name += between;
        const auto entry = static_cast<std::size_t>(stimulus.*stimulus_lists[list].index);
        name += entries[entry % entries.size()].id; // views count on with the sizes of slots
    }
    if (const std::size_t size = size_of_view(header, stimulus.view); size > 0)
        if (const std::vector<int> first = slots_of_sizes(header); size < first.size())
            name.append(between).append(header.slots[static_cast<std::size_t>(first[size])].id);
    if (!header.display.stereo.empty())
        name.append(between).append(
            static_cast<std::size_t>(stimulus.view) < header.views_of_an_eye() ? "left" : "right");
    return name;
}

} // namespace overt
