#include "app/rig/rig_facts.h"

#include <algorithm>

#include <fmt/format.h>
#include <sys/utsname.h>

#include "experiment/ports/button_box_kinds.h"
#include "experiment/ports/marker_output_kinds.h"
#include "experiment/ports/tracker_kinds.h"

namespace overt {
namespace {

/// "observer (xid at /dev/ttyUSB0), operator (hid)", or that there are none.
template <class Devices> std::string list_of_devices(const Devices& devices) {
    std::string list;
    for (const auto& device : devices)
        list += fmt::format("{}{} ({}{})", list.empty() ? "" : ", ", device.id, name_of(device.kind),
                            device.address.empty() ? "" : " at " + device.address);
    return list.empty() ? "none" : list;
}

} // namespace

const RigFact* fact_called(const RigFacts& facts, std::string_view what) {
    const auto found = std::ranges::find(facts, what, &RigFact::what);
    return found == facts.end() ? nullptr : &*found;
}

RigFacts facts_of_protocol(const Protocol& protocol) {
    utsname system{};
    uname(&system);
    const DisplaySettings& display = protocol.display;
    const TrackerSettings& tracker = protocol.tracker;
    return {{machine_fact, system.nodename},
            {screen_fact,
             fmt::format("{} x {} px at {:g} Hz", display.width_px, display.height_px, display.refresh_hz)},
            {output_fact, std::string(name_of(display.output))},
            {tracker_fact,
             row_of(tracker.kind).measures_gaze
                 ? fmt::format("{}{} at {:g} Hz", name_of(tracker.kind),
                               tracker.address.empty() ? "" : " at " + tracker.address, tracker.rate_hz)
                 : std::string("none")},
            {boxes_fact, list_of_devices(protocol.button_boxes)},
            {markers_fact, list_of_devices(protocol.marker_outputs)}};
}

void add_screen_facts(RigFacts& facts, const GlDescription& graphics, const MonitorInfo* monitor) {
    facts.push_back({graphics_fact, fmt::format("{}, {}", graphics.renderer, graphics.version)});
    facts.push_back(
        {monitor_fact, !monitor
                           ? std::string("none")
                           : monitor->name + (monitor->edid_name.empty() ? "" : ", " + monitor->edid_name)});
}

void add_model_fact(RigFacts& facts, const TrackerDescription& tracker) {
    if (!tracker.model.empty())
        facts.push_back({model_fact, tracker.model.substr(0, tracker.model.find(", its "))});
}

void add_box_fact(RigFacts& facts, const std::string& product, const std::string& serial_number) {
    facts.push_back({display_box_fact, fmt::format("{} {}", product, serial_number)});
}

std::vector<std::string> differences_between(const RigFacts& then, const RigFacts& now) {
    std::vector<std::string> changed;
    for (const RigFact& fact : then)
        if (const RigFact* const same = fact_called(now, fact.what); same && same->is != fact.is)
            changed.push_back(fmt::format("{} was {}, is {}", fact.what, fact.is, same->is));
    return changed;
}

} // namespace overt
