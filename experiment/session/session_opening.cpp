#include "experiment/session/session_opening.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/content_hash.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/session/observer_form.h"
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
    if (!is_known && (!ask_for_consent() || !fill_in_form()))
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

bool SessionOpening::fill_in_form() {
    const std::vector<ObserverFieldSettings>& fields = state_.protocol.observer_fields;
    const bool is_full =
        std::none_of(fields_.begin(), fields_.end(), [](const auto& value) { return value.empty(); });
    if (fields.empty())
        return true;
    if (!is_full && state_.ports.can_type) {
        ObserverForm form(fields, fields_, state_.protocol.words);
        const auto show = [&] { state_.ports.panel.await_entry(state_.show(form.screen())); };
        show();
        for (bool is_submitted = false; !is_submitted;) {
            bool is_changed = false;
            while (const std::optional<ResponsePress> press = state_.ports.panel.poll()) {
                if (is_operators(press->key)) {
                    if (!control_.act_on(*press))
                        return false;
                    show();
                } else if (form.take(*press)) {
                    is_submitted = true;
                    break;
                }
                is_changed = true;
            }
            if (state_.ends_by_itself())
                return false;
            // Several keys in one look: drawn once. Presses that come while it is drawn are kept.
            if (is_changed && !is_submitted)
                state_.show(form.screen());
            if (!is_changed)
                state_.ports.clock.wait_until(state_.now() + key_interval);
        }
        fields_ = form.values();
    }
    state_.log().observer_fields(filled_in(fields, fields_));
    return true;
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
