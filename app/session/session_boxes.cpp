#include "app/session/session_boxes.h"

#include <fmt/format.h>

#include "app/rig/button_boxes.h"

namespace overt {

FoundBox find_box(const DisplaySettings& display, const RunOptions& options) {
    switch_back_what_was_left();
    const BoxPlan plan = plan_box(display, wants_window(options.context), options.virtual_time);
    if (plan.use != RecordedBox::Use::box)
        return {plan.use, {}};
    return {plan.use, require_box(plan)};
}

BoxInUse::BoxInUse(const FoundBox& found, const DisplaySettings& display, Rig& rig) {
    recorded_.use = found.use;
    if (found.identity) {
        fmt::print("display box: switching {} at {} …\n", found.identity->product, found.identity->port);
        session_.emplace(*found.identity, display, rig.clock(), rig.leading_presenter());
        recorded_ = session_->recorded();
    }
    fmt::print("display box: {}\n", describe(recorded_));
}

void BoxInUse::write_beginning(SessionStore& store) {
    if (session_)
        session_->write_beginning(store);
    else
        store.display_box(recorded_);
}

void BoxInUse::check(SessionStore& store) {
    if (session_)
        session_->check(store);
}

void BoxInUse::leave(SessionStore& store) {
    if (session_)
        session_->leave(store);
}

std::unique_ptr<ResponsePanel> open_button_boxes(const Protocol& protocol, Rig& rig, BoxInUse& box,
                                                 const RunOptions& options,
                                                 const std::function<void(const std::string&)>& tell) {
    if (protocol.button_boxes.empty())
        return nullptr;
    if (options.virtual_time) {
        tell("response boxes are not read: time is virtual");
        return nullptr;
    }
    return make_button_boxes(protocol, rig.clock(), &rig.panel(), box.display_box(), tell);
}

} // namespace overt
