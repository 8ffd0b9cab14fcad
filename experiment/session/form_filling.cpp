#include "experiment/session/form_filling.h"

#include <algorithm>

#include "experiment/session/observer_form.h"

namespace overt {

namespace {

/// The form on the screen until it is submitted; false: the session is over.
bool show_form(SessionState& state, OperatorControl& control, ObserverForm& form) {
    const auto show = [&] { state.ports.panel.await_entry(state.show(form.screen())); };
    show();
    for (;;) {
        bool is_changed = false;
        while (const std::optional<ResponsePress> press = state.ports.panel.poll()) {
            if (is_operators(press->key)) {
                if (!control.act_on(*press))
                    return false;
                show();
            } else if (form.take(*press)) {
                return true;
            }
            is_changed = true;
        }
        if (state.ends_by_itself())
            return false;
        if (control.await_keyboard()) {
            if (state.is_over())
                return false;
            show();
        }
        // Several keys in one look: drawn once. Presses that come while it is drawn are kept.
        if (is_changed)
            state.show(form.screen());
        else
            state.ports.clock.wait_until(state.now() + key_interval);
    }
}

} // namespace

bool fill_in_form(SessionState& state, OperatorControl& control, FieldValues& values,
                  const std::string& when) {
    const std::vector<ObserverFieldSettings>& all = state.protocol.observer_fields;
    const std::vector<ObserverFieldSettings> fields = fields_asked(all, when);
    if (fields.empty())
        return true;
    FieldValues own;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].when == when)
            own.push_back(values[i]);
    const bool is_full = std::ranges::none_of(own, [](const std::string& value) { return value.empty(); });
    if (!is_full && state.ports.can_type) {
        ObserverForm form(fields, own, state.protocol.words);
        if (!show_form(state, control, form))
            return false;
        own = form.values();
    }
    std::size_t next = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].when == when)
            values[i] = own[next++];
    state.log().observer_fields(filled_in(fields, own, state.now()));
    return true;
}

} // namespace overt
