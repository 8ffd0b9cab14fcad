#include "experiment/answers/answer_sheet.h"

#include <algorithm>

#include "experiment/answers/answer_kinds.h"
#include "experiment/base/text_number.h"

namespace overt {

namespace {

/// More than a person does in a trial; kept ready so that none is lost or waited for.
constexpr std::size_t most_inputs = 4096;

/// Moves of the mouse within it are one in the record.
constexpr SessionDuration shortest_move = std::chrono::milliseconds(4);

using InputKind = ObserverInput::Kind;

bool is_equal_value(const std::string& value, const std::string& correct) {
    const std::optional<double> one = number_in<double>(value), other = number_in<double>(correct);
    return one && other ? *one == *other : value == correct;
}

} // namespace

bool HeldKeys::press(const ObserverInput& input) noexcept {
    const HeldKey key{input.device, input.key};
    const auto end = held_.begin() + static_cast<std::ptrdiff_t>(count_);
    if (std::find(held_.begin(), end, key) != end)
        return false;
    if (count_ < held_.size())
        held_[count_++] = key;
    return true;
}

void HeldKeys::release(const ObserverInput& input) noexcept {
    const HeldKey key{input.device, input.key};
    const auto end = held_.begin() + static_cast<std::ptrdiff_t>(count_);
    if (const auto found = std::find(held_.begin(), end, key); found != end)
        *found = held_[--count_];
}

AnswerSheet::AnswerSheet(const std::vector<AnswerForm>& forms, bool waits_unseen)
    : waits_unseen_(waits_unseen) {
    int on_page = 0;
    for (const AnswerForm& form : forms) {
        const int per_screen = form.settings->per_screen;
        if (!asked_.empty() && per_screen > 0 && on_page >= per_screen) {
            ++page_;
            on_page = 0;
        }
        ++on_page;
        Asked& asked = asked_.emplace_back();
        asked.answering = row_of(form.settings->kind).make(form);
        asked.page = page_;
    }
    pages_ = page_ + 1;
    page_ = 0;
    taken_.reserve(most_inputs);
}

AnswerOpening::From AnswerSheet::opens_from(const Asked& asked) const noexcept {
    using From = AnswerOpening::From;
    if (asked.page > 0)
        return From::screen;
    const From from = asked.settings().opens.from;
    return from != From::usual ? from : waits_unseen_ ? From::onset : From::screen;
}

void AnswerSheet::open_by(AnswerOpening::From from, SessionTime at) noexcept {
    for (Asked& asked : asked_) {
        if (asked.window.opens || opens_from(asked) != from || asked.page > page_)
            continue;
        const TaskAnswer& settings = asked.settings();
        asked.window.opens =
            at + (asked.page == 0 ? from_seconds(settings.opens.after_s) : SessionDuration::zero());
        if (settings.limit_s)
            asked.window.closes = *asked.window.opens + from_seconds(*settings.limit_s);
    }
}

void AnswerSheet::stimulus_lit(SessionTime onset) noexcept {
    stimulus_onset_ = onset;
    open_by(AnswerOpening::From::onset, onset);
}

void AnswerSheet::stimulus_gone(SessionTime offset) noexcept {
    // Of the shows before its own nothing opens.
    if (stimulus_onset_)
        open_by(AnswerOpening::From::offset, offset);
}

void AnswerSheet::screen_lit(SessionTime onset) noexcept {
    for (Asked& asked : asked_)
        if (asked.page == page_ && !asked.screen_onset)
            asked.screen_onset = onset;
    open_by(AnswerOpening::From::screen, onset);
}

void AnswerSheet::close(SessionTime at) noexcept {
    for (Asked& asked : asked_)
        if (!asked.window.closes || *asked.window.closes > at)
            asked.window.closes = at;
}

void AnswerSheet::pause(SessionDuration for_so_long) noexcept {
    for (Asked& asked : asked_)
        if (asked.window.closes)
            *asked.window.closes += for_so_long;
}

bool AnswerSheet::is_given() const noexcept { return std::ranges::all_of(asked_, &Asked::is_given); }

int AnswerSheet::given_count() const noexcept {
    return static_cast<int>(std::ranges::count(asked_, true, &Asked::is_given));
}

SessionTime AnswerSheet::given_last_at() const noexcept {
    SessionTime last;
    for (const Asked& asked : asked_)
        if (asked.is_given)
            last = std::max(last, *asked.answered_at);
    return last;
}

std::size_t AnswerSheet::first_on(int page) const noexcept {
    std::size_t i = 0;
    while (i < asked_.size() && asked_[i].page < page)
        ++i;
    return i;
}

std::size_t AnswerSheet::end_of(int page) const noexcept { return first_on(page + 1); }

bool AnswerSheet::take(const ObserverInput& input, const AnswerPlace& place) noexcept {
    Taken taken{.input = input, .asked = std::min(here_, asked_.size() - 1)};
    taken.state = asked_[taken.asked].window.state_at(input.at);
    bool has_changed = false;
    switch (input.kind) {
    case InputKind::let_go:
        held_.release_all();
        is_button_down_ = is_accept_down_ = false;
        break;
    case InputKind::key_up:
        held_.release(input);
        break;
    case InputKind::key_down:
        if (!held_.press(input))
            return false;
        look_for_tie(input);
        has_changed = take_key(taken, place);
        break;
    case InputKind::pointer_down:
    case InputKind::pointer_moved:
    case InputKind::pointer_up:
        has_changed = take_pointer(taken, place);
        if (input.kind == InputKind::pointer_moved && !taken.has_counted)
            return false;
        break;
    case InputKind::text:
    case InputKind::wheel:
    case InputKind::dial:
    case InputKind::tilt:
        has_changed = let_answer(taken, place);
        break;
    }
    note(taken);
    return has_changed;
}

bool AnswerSheet::take_key(Taken& taken, const AnswerPlace& place) noexcept {
    if (taken.state != InputState::open || is_complete())
        return false;
    const std::string_view key = taken.input.key.view();
    Asked& asked = asked_[taken.asked];
    if (asked.settings().accepts_by_key() && key == asked.settings().accept_key) {
        taken.has_counted = accept(asked, taken.input);
        return taken.has_counted;
    }
    const bool has_several = end_of(page_) - first_on(page_) > 1;
    if (has_several && (key == "up" || key == "down" || key == "tab")) {
        step_aside(key == "up" ? -1 : 1);
        return true;
    }
    return let_answer(taken, place);
}

bool AnswerSheet::take_pointer(Taken& taken, const AnswerPlace& place) noexcept {
    const bool is_down = taken.input.kind == InputKind::pointer_down;
    const bool is_up = taken.input.kind == InputKind::pointer_up;
    if (!is_complete() && place.item >= 0 && is_down &&
        first_on(page_) + static_cast<std::size_t>(place.item) < end_of(page_))
        here_ = first_on(page_) + static_cast<std::size_t>(place.item);
    taken.asked = std::min(here_, asked_.size() - 1);
    taken.state = asked_[taken.asked].window.state_at(taken.input.at);
    if (is_down) {
        is_button_down_ = true;
        is_accept_down_ = place.is_accept;
    } else if (!is_button_down_) {
        return false;
    }
    bool has_changed = false;
    if (is_up && is_accept_down_ && place.is_accept)
        has_changed = taken.state == InputState::open && accept_all(taken);
    else if (!is_accept_down_)
        has_changed = let_answer(taken, place);
    if (is_up)
        is_button_down_ = is_accept_down_ = false;
    return has_changed;
}

bool AnswerSheet::let_answer(Taken& taken, const AnswerPlace& place) noexcept {
    if (taken.state != InputState::open || is_complete())
        return false;
    Asked& asked = asked_[taken.asked];
    const Answering::Effect effect = asked.answering->take(taken.input, place);
    if (effect == Answering::Effect::none)
        return false;
    taken.has_counted = true;
    if (!asked.first_input_at)
        asked.first_input_at = taken.input.at;
    if (effect == Answering::Effect::touched)
        return true;
    if (effect == Answering::Effect::accepted)
        return accept(asked, taken.input);
    ++asked.changes;
    asked.changed_at = taken.input.at;
    asked.is_done = asked.is_given = false;
    if (effect == Answering::Effect::chosen && !asked.settings().accepts_by_key()) {
        give(asked, taken.input);
        go_on(taken.input.at);
    }
    return true;
}

void AnswerSheet::give(Asked& asked, const ObserverInput& input) noexcept {
    asked.is_done = asked.is_given = true;
    asked.answered_at = input.at;
    asked.uncertainty = input.uncertainty;
    asked.key = input.key;
    asked.device = input.device;
}

/// Gives what it says; without a value, passes over what is not required.
bool AnswerSheet::accept(Asked& asked, const ObserverInput& input) noexcept {
    const bool is_sound = asked.answering->is_sound();
    if (asked.answering->has_value() ? !is_sound : asked.settings().is_required)
        return false;
    if (asked.answering->has_value())
        give(asked, input);
    asked.is_done = true;
    go_on(input.at);
    return true;
}

bool AnswerSheet::accept_all(Taken& taken) noexcept {
    const int page = page_;
    for (std::size_t i = first_on(page); i < end_of(page); ++i)
        if (!asked_[i].is_done)
            taken.has_counted = accept(asked_[i], taken.input) || taken.has_counted;
    return taken.has_counted;
}

/// To what is not done yet on this page, then to the next page.
void AnswerSheet::go_on(SessionTime at) noexcept {
    const std::size_t first = first_on(page_), end = end_of(page_);
    for (std::size_t i = 0; i < end - first; ++i) {
        const std::size_t next = first + (here_ - first + i) % (end - first);
        if (!asked_[next].is_done) {
            here_ = next;
            return;
        }
    }
    // Until its time is over a last press may still change what the first one said.
    for (std::size_t i = first; i < end; ++i)
        if (asked_[i].settings().counts == AnswerCounts::last && !asked_[i].settings().accepts_by_key())
            return;
    here_ = end;
    if (++page_ == pages_)
        completed_at_ = at;
}

void AnswerSheet::step_aside(int by) noexcept {
    const std::size_t first = first_on(page_), count = end_of(page_) - first;
    here_ = first + (here_ - first + count + static_cast<std::size_t>(by + static_cast<int>(count))) % count;
}

/// Another key that answers, at the very time of the one that did: which was first nobody knows.
void AnswerSheet::look_for_tie(const ObserverInput& input) noexcept {
    for (Asked& asked : asked_)
        if (asked.is_given && asked.answered_at == input.at && !(asked.key == input.key) &&
            std::ranges::find(asked.settings().keys, input.key.view()) != asked.settings().keys.end())
            asked.is_tied = true;
}

void AnswerSheet::note(const Taken& taken) noexcept {
    // A mouse tells its moves up to 8000 times a second: what the screen cannot show apart is one.
    if (taken.input.kind == InputKind::pointer_moved) {
        const Taken* const last = taken_.empty() ? nullptr : &taken_.back();
        if (last && last->input.kind == InputKind::pointer_moved && last->asked == taken.asked &&
            last->state == taken.state && taken.input.at - moved_since_ < shortest_move)
            taken_.pop_back();
        else
            moved_since_ = taken.input.at;
    }
    if (taken_.size() == taken_.capacity()) {
        ++lost_inputs_;
        return;
    }
    taken_.push_back(taken);
    taken_.back().number = asked_[taken.asked].answering->number();
    taken_.back().attitude = asked_[taken.asked].answering->attitude();
}

std::optional<SessionTime> AnswerSheet::is_over_at(SessionTime now) const noexcept {
    if (is_complete() &&
        std::ranges::all_of(asked_, [](const Asked& asked) { return asked.settings().ends_step; }))
        return completed_at_;
    std::optional<SessionTime> last;
    for (const Asked& asked : asked_) {
        const bool may_change =
            asked.settings().counts == AnswerCounts::last && !asked.settings().accepts_by_key();
        if (is_complete() ? asked.settings().ends_step : asked.is_done && !may_change)
            continue;
        if (!asked.window.closes || *asked.window.closes >= now)
            return std::nullopt;
        last = std::max(last.value_or(*asked.window.closes), *asked.window.closes);
    }
    return last;
}

std::optional<SessionTime> AnswerSheet::ends_stimulus_at() const noexcept {
    const bool ends =
        std::ranges::all_of(asked_, [](const Asked& asked) { return asked.settings().ends_stimulus; });
    return ends ? completed_at_ : std::nullopt;
}

AnswerView AnswerSheet::view(const std::string& accept) const {
    AnswerView view;
    const int page = std::min(page_, pages_ - 1);
    bool is_accepted = false;
    view.can_accept = true;
    for (std::size_t i = first_on(page); i < end_of(page); ++i) {
        const Asked& asked = asked_[i];
        AnswerItem& item = view.items.emplace_back();
        item.question = asked.settings().question;
        if (const std::string& of = asked.answering->form().item; !of.empty())
            item.question += (item.question.empty() ? "" : "\n") + of;
        asked.answering->draw(item);
        item.is_here = i == here_;
        is_accepted = is_accepted || asked.settings().accepts_by_key();
        view.shows_pointer =
            view.shows_pointer || asked.settings().with != AnsweredWith::keys || asked.answering->points();
        const bool is_sound =
            asked.answering->has_value() ? asked.answering->is_sound() : !asked.settings().is_required;
        view.can_accept = view.can_accept && is_sound;
    }
    if (is_accepted)
        view.accept = accept;
    return view;
}

const Answering* AnswerSheet::gauge() const noexcept {
    for (const Asked& asked : asked_)
        if (asked.page == page_ && !asked.is_done && asked.answering->attitude())
            return asked.answering.get();
    return nullptr;
}

std::vector<AnswerOffer> AnswerSheet::offers() const {
    std::vector<AnswerOffer> offers;
    for (const Asked& asked : asked_) {
        if (asked.page != page_ || asked.is_done)
            continue;
        const TaskAnswer& settings = asked.settings();
        const AnswerForm& form = asked.answering->form();
        AnswerOffer& offer = offers.emplace_back();
        offer.id = settings.id;
        offer.item = form.item;
        offer.kind = name_of(settings.kind);
        offer.correct = form.correct;
        offer.limit_s = settings.limit_s;
        if (settings.accepts_by_key())
            offer.accept_key = settings.accept_key;
        asked.answering->offer(offer);
    }
    return offers;
}

std::optional<AnswerSheet::SetLevel> AnswerSheet::level_of(int place) const noexcept {
    for (const Asked& asked : asked_) {
        const std::optional<int> level = asked.answering->level();
        if (level && asked.answering->form().levels.place == place)
            return SetLevel{*level, asked.changed_at};
    }
    return std::nullopt;
}

std::optional<SessionTime> AnswerSheet::opened_at() const noexcept {
    return is_complete() ? std::nullopt : asked_[here_].window.opens;
}

GivenAnswer AnswerSheet::given(const Asked& asked) const {
    const TaskAnswer& settings = asked.settings();
    const AnswerForm& form = asked.answering->form();
    const bool counts_from_stimulus = opens_from(asked) == AnswerOpening::From::onset;
    GivenAnswer given{.id = settings.id, .item = form.item, .kind = std::string(name_of(settings.kind))};
    given.zero = settings.zero.value_or(counts_from_stimulus ? AnswerZero::stimulus : AnswerZero::window);
    given.stimulus_onset = stimulus_onset_;
    given.window_onset = asked.window.opens;
    given.window_end = asked.window.closes;
    given.screen_onset = asked.screen_onset;
    given.first_input_at = asked.first_input_at;
    given.place = form.place;
    given.mapping = form.mapping;
    given.changes = asked.changes;
    given.is_tied = asked.is_tied;
    given.correct = form.correct;
    given.is_missed = !asked.is_given;
    asked.answering->add_details(given);
    if (given.is_missed) {
        if (settings.missed == MissedAnswer::wrong && !form.correct.empty())
            given.is_correct = false;
        return given;
    }
    given.value = asked.answering->value();
    given.number = asked.answering->number();
    given.key = asked.key.view();
    given.device = asked.device.view();
    given.answered_at = asked.answered_at;
    given.uncertainty = asked.uncertainty;
    if (!form.correct.empty())
        given.is_correct = is_equal_value(given.value, form.correct);
    return given;
}

void AnswerSheet::add_to(std::vector<GivenAnswer>& given_answers, std::vector<AnswerInput>& inputs) const {
    for (const Asked& asked : asked_)
        given_answers.push_back(given(asked));
    for (const Taken& taken : taken_)
        inputs.push_back({.id = asked_[taken.asked].settings().id,
                          .item = asked_[taken.asked].answering->form().item,
                          .input = taken.input,
                          .state = taken.state,
                          .has_counted = taken.has_counted,
                          .number = taken.number,
                          .attitude = taken.attitude});
}

} // namespace overt
