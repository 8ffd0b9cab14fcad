#include "experiment/session/session_opening.h"

#include <fmt/format.h>

#include "experiment/base/content_hash.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/session/form_filling.h"
#include "experiment/session/session_screens.h"

namespace overt {

namespace {

/// An observer who has not agreed after so long has left.
constexpr double longest_reading_s = 3600.0;

} // namespace

bool read_text(SessionState& state, OperatorControl& control, const std::string& text, std::string what) {
    if (text.empty())
        return true;
    const Screen screen = screens::text(state.protocol, text);
    const SessionTime onset = state.show(screen);
    state.note(text_shown_event, std::move(what));
    const auto how = control.wait({.screen = screen, .onset = onset, .max_s = without_end_s}).how;
    return how != OperatorControl::How::session_over && how != OperatorControl::How::trial_over;
}

void SessionOpening::run(bool is_known) {
    if (!is_known &&
        (!ask_for_consent() || !fill_in_form(state_, control_, fields_, std::string(form_at_begin))))
        return;
    if (read_text(state_, control_, state_.protocol.screens.welcome_text, "welcome"))
        read_instructions();
}

bool SessionOpening::ask_for_consent() {
    const std::string& text = state_.protocol.consent.text;
    if (text.empty())
        return true;
    const Screen screen = screens::consent(state_.protocol);
    const auto await = [&](SessionTime since) { state_.ports.panel.await_decision(true, since); };
    for (;;) {
        const OperatorControl::Press press = control_.wait(
            {.screen = screen, .onset = state_.show(screen), .max_s = longest_reading_s, .await = await});
        using How = OperatorControl::How;
        if (press.how == How::next || press.how == How::back)
            continue; // neither key accepts or declines
        if (press.how == How::session_over)
            return false;
        const bool accepted = press.how == How::yes;
        state_.log().consent({state_.ports.observer, accepted, press.at, {}, hash_of_text(text)});
        if (!accepted)
            state_.end_session(press.how == How::no ? "the observer declined to take part"
                                                    : "nobody agreed to take part");
        return accepted;
    }
}

void SessionOpening::read_instructions() {
    const std::vector<std::string>& pages = state_.protocol.instructions.pages;
    for (std::size_t page = 0; page < pages.size();) {
        const Screen screen = screens::instructions(state_.protocol, page);
        const SessionTime onset = state_.show(screen);
        state_.note(text_shown_event, fmt::format("instructions, page {} of {}", page + 1, pages.size()));
        const OperatorControl::Press press =
            control_.wait({.screen = screen, .onset = onset, .max_s = without_end_s, .turns_pages = true});
        if (press.how == OperatorControl::How::session_over)
            return;
        if (press.how != OperatorControl::How::back)
            ++page;
        else if (page > 0)
            --page;
    }
}

} // namespace overt
