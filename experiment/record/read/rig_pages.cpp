#include "experiment/record/read/rig_pages.h"

#include "experiment/ports/event_kinds.h"

namespace overt {

std::vector<NamedRigPage> rig_pages_of(const SessionRecord& record) {
    std::vector<NamedRigPage> pages;
    record.read_events([&](const RecordedEvent& event) {
        if (event.kind == rig_page_event)
            pages.push_back({event.sitting, event.detail});
    });
    return pages;
}

} // namespace overt
