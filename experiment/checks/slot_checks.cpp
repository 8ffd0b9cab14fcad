#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "experiment/checks/protocol_checks.h"
#include "experiment/design/block_plan.h"
#include "experiment/protocol/entry_ids.h"
#include "experiment/stimulus/frame_memory.h"
#include "experiment/stimulus/photodiode_patch.h"

namespace overt {

namespace {

std::string slot_path(std::size_t index, std::string_view key) {
    return fmt::format("slot[{}].{}", index, key);
}

/// A key that says nothing without another.
void check_idle_slot_key(ProtocolExamination& examination, std::size_t index, std::string_view key,
                         std::string_view without) {
    const std::string path = slot_path(index, key);
    if (examination.is_written(path) && !examination.is_written(slot_path(index, without)))
        examination.error({path}, fmt::format("\"{}\" says nothing without \"{}\"", key, without));
}

/// What belongs together in an entry. Whether its places can be made of it.
bool check_slot_entry(ProtocolExamination& examination, std::size_t index) {
    const SlotSettings& entry = examination.protocol.slot_entries[index];
    const auto path = [&](std::string_view key) { return slot_path(index, key); };
    const auto needs = [&](std::string_view key, std::string_view needed, double value) {
        if (value > 0.0)
            return true;
        examination.error(
            {path(needed), path(key)},
            fmt::format("\"{}\" needs \"{}\" above 0, or all places would be one", key, needed));
        return false;
    };
    for (const std::string_view side : {"width_deg", "height_deg"})
        if (entry.size_deg && examination.is_written(path(side)))
            examination.error({path(side)}, "size_deg already says how large the slot is");
    check_idle_slot_key(examination, index, "radius_deg", "circle");
    check_idle_slot_key(examination, index, "distance_deg", "grid");
    if (entry.circle > 0 && !entry.grid.empty()) {
        examination.error({path("grid")}, "the places are on a circle already");
        return false;
    }
    if (entry.circle > 1)
        return needs("circle", "radius_deg", entry.radius_deg);
    if (entry.grid.empty())
        return true;
    if (entry.grid.size() != 2 || entry.grid[0] != std::floor(entry.grid[0]) ||
        entry.grid[1] != std::floor(entry.grid[1])) {
        examination.error({path("grid")}, "a grid is two whole numbers: its columns and its rows",
                          "such as grid = [3, 2]");
        return false;
    }
    return entry.grid[0] * entry.grid[1] < 2.0 || needs("grid", "distance_deg", entry.distance_deg);
}

/// Whether two boxes share a pixel, or come closer than a distance.
bool come_closer(glm::ivec2 one, glm::ivec2 one_end, glm::ivec2 other, glm::ivec2 other_end,
                 int distance_px) {
    return one.x < other_end.x + distance_px && one_end.x + distance_px > other.x &&
           one.y < other_end.y + distance_px && one_end.y + distance_px > other.y;
}

/// "columns 100 to 399 and rows 20 to 319".
std::string pixels_of(const ScreenGeometry& at) {
    const glm::ivec2 last = at.image_origin_px + at.image_px - 1;
    return fmt::format("columns {} to {} and rows {} to {}", at.image_origin_px.x, last.x,
                       at.image_origin_px.y, last.y);
}

/// A slot whose whole place cannot be used: beyond the screen, on rows or a square that are something else's.
void check_slot_place(ProtocolExamination& examination, const Slot& slot) {
    const Protocol& protocol = examination.protocol;
    const DisplaySettings display = display_of_field(protocol);
    const ScreenGeometry at = slot_geometry(protocol, slot);
    const glm::ivec2 first = at.image_origin_px, end = first + at.image_px;
    const auto error = [&](std::string message, std::string hint) {
        std::vector<std::string> paths;
        for (const std::string_view key : {"right_deg", "up_deg", "radius_deg", "distance_deg", "size_deg",
                                           "width_deg", "height_deg", "id"})
            paths.push_back(slot_path(static_cast<std::size_t>(slot.entry), key));
        examination.error(paths, fmt::format("slot \"{}\" takes {}{}", slot.id, pixels_of(at), message),
                          hint);
    };
    if (first.x < 0 || first.y < 0 || end.x > display.width_px || end.y > display.height_px) {
        error(fmt::format(", the screen has columns 0 to {} and rows 0 to {}", display.width_px - 1,
                          display.height_px - 1),
              "make it smaller, or place it nearer to the middle");
    } else if (const int rows = reserved_rows(display.output); first.y < rows) {
        error(fmt::format(", but {} keeps the first {} for messages to the display", name_of(display.output),
                          rows == 1 ? "row" : fmt::format("{} rows", rows)),
              "place it lower");
    }
    const int reach = pair_reach_px(display);
    if (reach > 0 && (first.x < reach || end.x + reach > display.width_px))
        error(fmt::format(", where pair_filter = \"{}\" reaches {} px beyond and over the edge of the screen",
                          name_of(display.pair_filter), reach),
              "place it nearer to the middle, or take pair_filter = \"box\"");
    const std::optional<PatchPlace> patch = photodiode_patch_of(display);
    if (patch && come_closer(first, end, patch->origin_px, patch->end_px(), patch_distance_px))
        error(fmt::format(", closer than {} px to the square for a photodiode", patch_distance_px),
              "take another corner for the square, or a smaller photodiode_px");
}

/// What another program has drawn has one size.
void check_one_size(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const auto other = std::ranges::find_if(protocol.slots, [](const Slot& slot) { return slot.size > 0; });
    if (other == protocol.slots.end())
        return;
    const auto error = [&](const std::string& path, std::string_view what) {
        examination.error({path},
                          fmt::format("{} are of one size, and slots \"{}\" and \"{}\" are not", what,
                                      protocol.slots.front().id, other->id),
                          "give all slots one size, or have overt draw the stimuli");
    };
    if (!protocol.frames.empty())
        error("frames[0]", "ready-made frames");
    for (std::size_t i = 0; i < protocol.objects.size(); ++i)
        if (!protocol.objects[i].lut.empty())
            error(fmt::format("object[{}].lut", i), "ready-made maps");
}

void check_slots_of_task(ProtocolExamination& examination, std::size_t index) {
    const Protocol& protocol = examination.protocol;
    const Task& task = protocol.tasks[index];
    const std::string path = fmt::format("task[{}].slots", index);
    std::vector<std::string> known = ids_of(protocol.slots);
    for (const SlotSettings& entry : protocol.slot_entries)
        known.push_back(entry.id);
    bool are_known = true;
    for (const std::string& name : task.slots)
        are_known = is_known(examination, path, "slot", name, {known.begin(), known.end()}) && are_known;
    if (task.slots.empty() && protocol.slots.size() > 1)
        examination.error({fmt::format("task[{}]", index)},
                          fmt::format("task \"{}\" does not say in which of the {} slots it shows stimuli",
                                      task.id, protocol.slots.size()),
                          "write slots = [ … ] with their ids");
    // What steps show is looked at step by step.
    if (are_known && task.steps.empty())
        check_slots_apart(examination, path, slots_of_task(protocol, static_cast<int>(index)));
}

} // namespace

namespace {

using ReportSlots = std::function<void(const std::string& message, const std::string& hint)>;

void check_apart(const Protocol& protocol, std::span<const int> shown_at_once, const ReportSlots& report) {
    const auto slot_at = [&](std::size_t i) -> const Slot& {
        return protocol.slots[static_cast<std::size_t>(shown_at_once[i])];
    };
    for (std::size_t i = 0; i < shown_at_once.size(); ++i) {
        const ScreenGeometry one = slot_geometry(protocol, slot_at(i));
        for (std::size_t j = 0; j < i; ++j) {
            if (shown_at_once[i] == shown_at_once[j])
                return report(fmt::format("slot \"{}\" is listed twice", slot_at(i).id), "");
            const ScreenGeometry other = slot_geometry(protocol, slot_at(j));
            if (come_closer(one.image_origin_px, one.image_origin_px + one.image_px, other.image_origin_px,
                            other.image_origin_px + other.image_px, 2 * pair_reach_px(protocol.display)))
                return report(
                    fmt::format("the slots \"{}\" and \"{}\" overlap: {}, and {}", slot_at(j).id,
                                slot_at(i).id, pixels_of(other), pixels_of(one)),
                    "make them smaller, place them farther apart, or show them in steps of their own");
        }
    }
}

} // namespace

void check_slots_apart(ProtocolExamination& examination, const std::string& path,
                       std::span<const int> shown_at_once) {
    check_apart(examination.protocol, shown_at_once,
                [&](const std::string& message, const std::string& hint) {
                    examination.error({path}, message, hint);
                });
}

void check_slots_apart(ProtocolExamination& examination, Place place, std::span<const int> shown_at_once) {
    check_apart(examination.protocol, shown_at_once,
                [&](const std::string& message, const std::string& hint) {
                    examination.diagnostics().error(examination.protocol.file.string(), place, message, hint);
                });
}

void check_slots(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    check_ids_differ(examination, "slot", ids_of<std::string_view>(protocol.slot_entries));
    std::vector<bool> are_places(protocol.slot_entries.size());
    for (std::size_t i = 0; i < protocol.slot_entries.size(); ++i)
        are_places[i] = check_slot_entry(examination, i);
    bool are_all_places = true;
    for (const Slot& slot : protocol.slots) {
        if (slot.entry < 0)
            continue;
        const auto entry = static_cast<std::size_t>(slot.entry);
        const int errors = examination.diagnostics().error_count();
        if (are_places[entry])
            check_slot_place(examination, slot);
        if (examination.diagnostics().error_count() > errors)
            are_places[entry] = false; // its further places would say the same again
        are_all_places = are_all_places && are_places[entry];
    }
    for (std::size_t i = 0; i < protocol.tasks.size() && are_all_places; ++i)
        check_slots_of_task(examination, i);
    check_one_size(examination);
}

void check_slot_memory(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    if (protocol.slots.size() == 1)
        return;
    const int stimuli = most_stimuli_at_once(protocol);
    const double trial_mb = 1e-6 * stimuli * most_pages(protocol) * page_bytes(protocol);
    if (trial_mb > protocol.display.frame_store_mb)
        examination.error(
            {"display.frame_store_mb", "slot"},
            fmt::format("the {} stimuli of a trial take {:.4g} MB of the frame store, which may take {}",
                        stimuli, trial_mb, protocol.display.frame_store_mb),
            fmt::format(
                "write frame_store_mb = {:.0f}, if the graphics card has as much ({:.0f} with the next "
                "trial's), or show fewer or smaller frames",
                std::ceil(trial_mb), std::ceil(2.0 * trial_mb)));
}

} // namespace overt
